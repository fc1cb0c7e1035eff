// Numbers from print that stand beside the model's.

export const paper = "Gao, Carrick, Berry, Griffith & Luo, IMA J. Appl. Math. 79:978, 2014";

export interface MeanSd { mean: number; sd: number }
const of = (mean: number, sd: number): MeanSd => ({ mean, sd });

/** At end-systole, over the whole wall of the paper's healthy subject. */
export const healthySubject: Record<string, MeanSd> = {
  fibre_strain: of(-0.19, 0.04),
  circumferential_strain: of(-0.18, 0.05),
  longitudinal_strain: of(-0.07, 0.04),
  radial_strain: of(0.64, 0.25),
  active_tension: of(81.9, 22.6),
  fibre_stress: of(64, 19),
};

export const volunteers = "Taylor et al., Eur. Heart J. Cardiovasc. Imaging 16:871, 2015";

/** Relative change of length e as Green-Lagrange strain E = e + e^2/2; its deviation is dE/de sd. */
const lagrange = (e: number, sd: number): MeanSd => of(e + (e * e) / 2, (1 + e) * sd);

/** Peak systolic strains of 100 healthy adults from feature tracking: -26.1 +- 3.8, -21.3 +- 4.8, 39.8 +- 8.3 %. */
export const healthyAdults: Record<string, MeanSd> = {
  circumferential_strain: lagrange(-0.261, 0.038),
  longitudinal_strain: lagrange(-0.213, 0.048),
  radial_strain: lagrange(0.398, 0.083),
};

/** At end-systole, in the paper's patient six months after an infarct. */
export const patient: Record<"remote" | "infarct", Record<string, MeanSd>> = {
  remote: {
    fibre_strain: of(-0.13, 0.06),
    circumferential_strain: of(-0.13, 0.05),
    longitudinal_strain: of(-0.06, 0.06),
    radial_strain: of(0.37, 0.23),
    active_tension: of(86.9, 22.7),
    fibre_stress: of(64, 22),
  },
  infarct: {
    fibre_strain: of(0.02, 0.02),
    circumferential_strain: of(0.01, 0.02),
    longitudinal_strain: of(0.03, 0.02),
    radial_strain: of(-0.04, 0.03),
    fibre_stress: of(65, 32),
  },
};
