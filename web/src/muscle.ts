// Stress against stretch along the fibre of passive muscle: incompressible, pulled along the fibre, sides free.
import type { Case } from "./data.ts";

/** Cauchy stress [kPa] at a stretch of 1 or more. */
export type Law = (stretch: number) => number;

/** a exp[b(I1-3)](l^2 - 1/l) + 2 a_f (l^2-1) l^2 exp[b_f (l^2-1)^2]; the sheet's terms are off in compression. */
export const holzapfelOgden = (a: number, b: number, a_f: number, b_f: number): Law => (l) =>
  a * Math.exp(b * (l * l + 2 / l - 3)) * (l * l - 1 / l) + 2 * a_f * (l * l - 1) * l * l * Math.exp(b_f * (l * l - 1) ** 2);

/** l dW/dl with W = C/2 (e^Q - 1), Q = b_f E_ff^2 + 2 b_t E_tt^2, E_ff = (l^2-1)/2, E_tt = (1/l-1)/2. */
export const guccione = (C: number, b_f: number, b_t: number): Law => (l) => {
  const E = 0.5 * (l * l - 1);
  const Et = 0.5 * (1 / l - 1);
  return C * Math.exp(b_f * E * E + 2 * b_t * Et * Et) * (b_f * E * l * l - (b_t * Et) / l);
};

/** mu (l^2 - 1/l). */
export const neoHookean = (mu: number): Law => (l) => mu * (l * l - 1 / l);

export interface NamedLaw { label: string; law: Law }

/** Published laws that can be drawn from their published parameters. */
export const publishedLaws: NamedLaw[] = [
  { label: "Holzapfel & Ogden 2009, excised pig muscle", law: holzapfelOgden(0.059, 8.023, 18.472, 16.026) },
  { label: "Gao et al. 2014, healthy subject", law: holzapfelOgden(0.24, 5.08, 1.46, 4.15) },
  { label: "Gao et al. 2014, patient's remote muscle", law: holzapfelOgden(0.24, 5.08, 7.5 * 1.46, 4.15) },
];

/** The law that a case's summary names; undefined when there is no summary. */
export function lawOf(c: Case): Law | undefined {
  const p = (name: string) => c.number(`passive.${name}`);
  switch (c.parameter("passive.law")) {
    case "holzapfel_ogden":
      return holzapfelOgden(p("holzapfel_ogden.a"), p("holzapfel_ogden.b"), p("C_a") * p("holzapfel_ogden.a_f"), p("holzapfel_ogden.b_f"));
    case "guccione":
      return guccione(p("guccione.C"), p("guccione.b_f"), p("guccione.b_t"));
    case "neo_hookean":
      return neoHookean(p("neo_hookean.mu"));
  }
  return undefined;
}

/** The curve up to where it reaches `limit` kPa, at most to a stretch of 1.3. */
export function curve(law: Law, limit = 12): { x: number[]; y: number[] } {
  const x: number[] = [];
  const y: number[] = [];
  for (let l = 1; l <= 1.3 + 1e-9 && law(l) <= limit; l += 0.0025) {
    x.push(l);
    y.push(law(l));
  }
  return { x, y };
}
