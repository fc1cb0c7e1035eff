#pragma once

#include <array>
#include <utility>

/// What --help says below the options.
namespace help {

inline constexpr const char* program =
    R"(A first run:
  ventricle new mine.toml --from labels.nii.gz   or without --from, for a starter
  ventricle validate mine.toml                   what is missing, what it will cost
  ventricle run mine.toml                        results and a page in mine.work
ventricle COMMAND --help says more of each command.

Exit codes:
    0  done
    1  the input cannot be used (or a verification failed); the message says why
    2  the computation could not go on
    3  a defect of the program
  130  stopped by Ctrl-C or kill; the same command goes on)";

inline constexpr std::array<std::pair<const char*, const char*>, 16> commands{{
    {"new",
     R"(With --from the case holds what the source shows: labels, frame, phases, septum,
unit, the pressure that a filled shape bears. What it cannot show stands there as
"FILL IN". Next: ventricle validate FILE, which asks for that.)"},
    {"validate",
     R"(Reads all that the case names, builds the wall and its mesh, tries a few steps and
writes nothing. All that is missing or wrong is told at once, with lines to paste
(exit code 1). The last line says what the beat takes on each engine, which warnings
matter, and the next command.)"},
    {"run",
     R"(Stages, each with a folder in the work folder. One whose inputs, parameters and
program have not changed is not run again.
  circulation 00_circulation the circulation by itself, for cases with circulation.kind
  strain     00_strain      strain of the muscle, for cases with cine images
  anatomy    01_anatomy     the surfaces of the wall and how well they fit
  mesh       02_mesh        elements, fibres, regions, infarct
  calibrate  02b_calibrate  parameters, for cases with [calibrate]
  unload     02c_unload     the wall without load, with unloaded.pressure
  beat       03_beat        filling and contraction, for ParaView
  results    04_results     tables, summary, pictures
  report     05_report      the page: report.html
Ctrl-C stops it with a checkpoint (exit code 130); the same command goes on.)"},
    {"study",
     R"(Set protocol.kind = "cycle" and lists of factors under [study], such as
preload = [0.8, 1.2]. Runs the case as ventricle run does, and each other load,
contractility and heart rate in study/NAME of its work folder, as if a case of its own
(ventricle compare CASE.work CASE.work/study/NAME). Writes study/study.csv, study.svg and
study.txt: loops, end-systolic elastance and volume intercept, preload-recruitable stroke
work. Ctrl-C stops it; the same command goes on.)"},
    {"calibrate",
     R"(Set calibrate.passive with calibrate.edv, calibrate.active with calibrate.esv, or
both. Writes 02b_calibrate/: calibrated.toml (the parameters), calibration.txt, .json
and .csv. `ventricle run` does it too.)"},
    {"segment",
     R"(Set anatomy.source = "cine" and segment.cine. Writes contours/ (a CSV file per phase, as
anatomy.source = "contours" reads them), quality.csv (confidence of each contour),
volumes.csv, pictures/ to look at and segmentation.txt: phases, and what is doubtful.
`ventricle run` does it too.)"},
    {"draw",
     R"(Set anatomy.source = "cine" and segment.cine. Prints the address of a page, on this machine
alone, that shows the borders of ventricle segment on the playing cine and lets you correct,
draw and delete them. Saves CASE.draw/contours/phase_NN.csv, as anatomy.source = "contours"
reads them. Ctrl-C ends it. With --export the page is one file, for another machine; what it
lets download comes back with --import.)"},
    {"strain",
     R"(Set strain.cine and strain.contours. Writes 00_strain/: strain and rotation per
slice, sector and segment at every phase; strain.txt says what was found.)"},
    {"circulation",
     R"(Set circulation.kind. Beats of the circulation alone, with an elastance for the left
ventricle, up to their limit cycle. Writes 00_circulation/: cycle.csv, beats.csv, the
pressure-volume loop and the Wiggers diagram as SVG; circulation.txt says what was found.)"},
    {"phantom",
     R"(Writes images (DICOM, NIfTI), label maps, contours, what is true of them (truth.json,
truth_segments.csv, truth_rotation.csv), and case.toml, ready for ventricle run.)"},
    {"verify",
     R"(Prints a line per quantity: its value, the known one, the tolerance. Exit code 1 if
one is off.)"},
    {"images",
     R"(Says of any file what it is, and ends with the lines by which a case uses it;
ventricle new FILE --from WHERE writes them into a case.)"},
    {"report",
     R"(One file with 3-D views, curves, bull's-eyes and tables, which opens in any browser
without a network. Nothing is computed, nothing changed in the work folder.)"},
    {"compare",
     R"(One file with both runs side by side, which opens in any browser without a network.
Nothing is computed, nothing changed in the work folders.)"},
    {"parameters",
     R"(Each with its default, what is allowed, its meaning and the paper's equation. A case
file sets what differs from the defaults: calcium.Ca_max is Ca_max = "1 uM" under
the heading [calcium].)"},
    {"bench",
     R"(Seconds per kernel of a step of the immersed engine, beside what this machine's
memory and processors allow.)"},
}};

}  // namespace help
