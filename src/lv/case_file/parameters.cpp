#include "lv/case_file/parameters.hpp"

#include "lv/case_file/conditions.hpp"
#include "lv/case_file/declarations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace lv::case_file {
namespace {

using namespace conditions;

constexpr Stages meshing(Stage::mesh, Stage::calibrate, Stage::unload);
constexpr Stages mechanics(Stage::calibrate, Stage::unload, Stage::beat);
constexpr Stages beating(Stage::calibrate, Stage::beat);
constexpr Stages joined(Stage::circulation, Stage::calibrate, Stage::beat);

constexpr Group of_anatomy[]{
    {Stages(Stage::results),
     {},
     {value(LV_NAMED(name), "name of the subject or case, for reports")}},
    {Stages(Stage::mesh, Stage::unload, Stage::beat),
     {},
     {choice(LV_NAMED(engine), "immersed quasi_static",
             "the dynamic immersed boundary model, or equilibrium without inertia and blood: "
             "the answer of slow loads, in seconds")}},
    {Stages(Stage::anatomy, Stage::mesh, Stage::calibrate, Stage::unload),
     {},
     {choice(LV_NAMED(anatomy.source),
             "ellipsoid contours mesh labels sunnybrook guide_points cine contour_file surfaces",
             "where the shape of the wall at early diastole comes from", "2.2")}},
    {Stages(Stage::anatomy),
     {&ellipsoid},
     {number(LV_NAMED(anatomy.ellipsoid.endo_radius), "mm", between(1.0, 200.0),
             "semi-axis of the endocardium across the long axis"),
      number(LV_NAMED(anatomy.ellipsoid.endo_length), "mm", between(1.0, 200.0),
             "semi-axis of the endocardium along the long axis"),
      number(LV_NAMED(anatomy.ellipsoid.epi_radius), "mm", between(1.0, 200.0),
             "semi-axis of the epicardium across the long axis"),
      number(LV_NAMED(anatomy.ellipsoid.epi_length), "mm", between(1.0, 200.0),
             "semi-axis of the epicardium along the long axis"),
      number(LV_NAMED(anatomy.ellipsoid.base_height), "mm", between(-100.0, 200.0),
             "height of the basal plane above the widest section")}},
    {Stages(Stage::anatomy),
     {&from_contours},
     {file(LV_NAMED(anatomy.contours.short_axis),
           "CSV of short-axis loops with columns slice, contour (endo or epi), point, x_mm, "
           "y_mm, z_mm in scanner coordinates; names are relative to the case file"),
      file(LV_NAMED(anatomy.contours.long_axis),
           "CSV of open curves on long-axis images, same columns; may be left out"),
      file(LV_NAMED(anatomy.contours.apex_endo),
           "CSV of points at the tip of the endocardium, same columns; may be left out"),
      file(LV_NAMED(anatomy.contours.apex_epi),
           "CSV of points at the tip of the epicardium, same columns; may be left out"),
      file(LV_NAMED(anatomy.contours.es_short_axis),
           "CSV of short-axis loops at end-systole on the same slices, same columns, from which "
           "the distance of the model's end-systolic surfaces is reported; may be left out")}},
    {Stages(Stage::strain, Stage::anatomy),
     {&base_may_tilt},
     {choice("anatomy.contours.base_plane", LV_AT(anatomy.contours.fit.frame.base_plane),
             "long_axis basal_slice",
             "the base plane through the centre of the most basal endocardial loop is normal to "
             "the long axis, or the plane of that loop",
             "2.2")}},
    {Stages(Stage::anatomy),
     {&drawn},
     {choice(LV_NAMED(anatomy.contours.base_at), "automatic slice slab annulus",
             "the base plane lies in the most basal endocardial loop, half a slice spacing "
             "above it where the slab of the slice ends, or at the mitral annulus (guide "
             "points, ends of long-axis curves); automatic: slice for contours, slab for "
             "labels, sunnybrook and cine; for guide_points as high as long-axis curves show "
             "muscle all round, else annulus, slab where that makes no wall")}},
    {Stages(Stage::strain, Stage::anatomy),
     {&septum_shown},
     {file(LV_NAMED(anatomy.contours.landmarks),
           "CSV of landmarks as ventricle draw saves it (landmark, slice, x_mm, y_mm, z_mm, by, "
           "when): insertions of the septum, tips of both surfaces, points of the mitral "
           "annulus, which then is where base_at = \"automatic\" lays the base plane; may be "
           "left out"),
      number("anatomy.contours.septum_point", LV_AT(anatomy.contours.fit.frame.septum), "mm", any,
             "a point of the middle of the septum in scanner coordinates: the model's x "
             "direction, from which regions are counted")}},
    {Stages(Stage::strain, Stage::anatomy),
     {&fitted},
     {number("anatomy.contours.intervals_around", LV_AT(anatomy.contours.fit.around), "",
             between(6, 64), "spline intervals about the long axis", "2.2"),
      number("anatomy.contours.intervals_along", LV_AT(anatomy.contours.fit.along), "",
             between(4, 64), "spline intervals from the apex to above the base", "2.2"),
      number("anatomy.contours.smoothing_length", LV_AT(anatomy.contours.fit.smoothing_length),
             "mm", between(0.0, 50.0),
             "ripples of 2 pi times this wave length are halved; 0: none"),
      number("anatomy.contours.margin", LV_AT(anatomy.contours.fit.margin), "mm",
             between(0.0, 50.0), "contour points up to this height above the base plane count"),
      value("anatomy.contours.correct_shifts", LV_AT(anatomy.contours.fit.correct_shifts),
            "move short-axis slices in their planes to agree with the long-axis contours "
            "(different breath-holds)"),
      whether_set(
          value("anatomy.contours.align_slices", LV_AT(anatomy.contours.fit.align_slices),
                "without two long-axis images, move short-axis slices in their planes to make the "
                "wall smooth; a tilt of the whole stack cannot be seen in this way and stays"))}},
    {Stages(Stage::strain, Stage::anatomy, Stage::mesh, Stage::calibrate, Stage::unload),
     {&fitted_or_moved},
     {number("anatomy.contours.largest_shift", LV_AT(anatomy.contours.fit.largest_shift), "mm",
             between(0.0, 50.0), "a slice that would have to move farther is an error")}},
    {Stages(Stage::anatomy),
     {&drawn},
     {number("anatomy.contours.thinnest_wall", LV_AT(anatomy.contours.fit.thinnest_wall), "mm",
             between(0.1, 20.0), "a thinner wall is an error")}},
    {Stages(Stage::anatomy),
     {&from_labels},
     {file(LV_NAMED(anatomy.labels.file),
           "label map (NIfTI, NRRD, MetaImage, DICOM SEG), of one or more times; names are "
           "relative to the case file"),
      value(LV_NAMED(anatomy.labels.cavity),
            "labels of the left ventricle's blood (with those of papillary muscles, if labelled)"),
      value(LV_NAMED(anatomy.labels.muscle), "labels of the left ventricle's muscle"),
      value(LV_NAMED(anatomy.labels.right_ventricle),
            "labels of the right ventricle: where the septum is; may be left out"),
      number(LV_NAMED(anatomy.labels.frame), "", between(0, 10000),
             "time of a map of several, counted from 1; 0: the only one")}},
    {Stages(Stage::anatomy),
     {&from_sunnybrook},
     {path(LV_NAMED(anatomy.sunnybrook.contours),
           "folder of text contours IM-0001-0059-icontour-manual.txt and so on, in pixels"),
      path(LV_NAMED(anatomy.sunnybrook.dicom), "folder of the DICOM files they were drawn on"),
      value(LV_NAMED(anatomy.sunnybrook.series),
            "series to use: number, description or SeriesInstanceUID, as `ventricle images` "
            "lists them; may be left out if there is one"),
      number(LV_NAMED(anatomy.sunnybrook.phase), "", between(0, 10000),
             "phase to use, counted from 1 in order of time among the DICOM files; 0: not chosen"),
      choice(LV_NAMED(anatomy.sunnybrook.pixel_origin), "corner centre",
             "pixel coordinates (0, 0) are the image's outer corner, or the centre of its first "
             "pixel"),
      choice("anatomy.sunnybrook.drawn", LV_AT(anatomy.sunnybrook.drawn_by), "manual auto",
             "which contours to use, as the file names say")}},
    {Stages(Stage::anatomy),
     {&from_cine},
     {path("segment.cine", LV_AT(anatomy.cine.images),
           "short-axis cine in which the program draws the borders: a folder of DICOM files or "
           "a NIfTI, NRRD or MetaImage file over time; names are relative to the case file"),
      value("segment.series", LV_AT(anatomy.cine.series),
            "DICOM: number, UID or description of the series; may be left out if there is one"),
      perhaps_path("segment.long_axis_cine", LV_AT(anatomy.cine.long_axis),
                   "long-axis cines, on which annulus and tip are looked for and ventricle draw "
                   "takes landmarks: files of images, or series of the DICOM folder cine, at "
                   "most four; [] leaves the base to the most basal slice"),
      number("segment.centre", LV_AT(anatomy.cine.segmentation.centre), "mm", any,
             "a point in the left ventricle's blood in scanner coordinates; none: found from "
             "motion and roundness"),
      number("segment.fall", LV_AT(anatomy.cine.segmentation.fall), "", between(0.0, 0.95),
             "the endocardium lies where this part of the way from the blood's grey value to "
             "the muscle's is reached, 0.5 or more: 0.5 in the middle of an edge, more outside "
             "trabeculae; 0: from how wide the study's own edges are"),
      choice("segment.moment", LV_AT(anatomy.cine.moment), "early_diastole end_diastole",
             "the time whose borders give the shape, proposed from the volume curve")}},
    {Stages(Stage::anatomy),
     {&from_contour_file},
     {path(LV_NAMED(anatomy.contour_file.file),
           "contours of another program: Segment (.mat), DICOM RTSTRUCT, cvi42 (.cvi42wsx); "
           "names are relative to the case file"),
      path(LV_NAMED(anatomy.contour_file.images),
           "folder of the DICOM images they were drawn on, which say slice and time: needed for "
           "cvi42, and for RTSTRUCT of several times"),
      value(LV_NAMED(anatomy.contour_file.series),
            "series of these images: number, description or SeriesInstanceUID; may be left out "
            "if there is one"),
      value(LV_NAMED(anatomy.contour_file.endo),
            "name of the endocardium's contours in the file; empty: as the format fixes it"),
      value(LV_NAMED(anatomy.contour_file.epi),
            "name of the epicardium's contours in the file; empty: as the format fixes it"),
      number(LV_NAMED(anatomy.contour_file.phase), "", between(0, 10000),
             "time of several, counted from 1; 0: the only one")}},
    {Stages(Stage::anatomy),
     {&from_surfaces},
     {file(LV_NAMED(anatomy.surfaces.endo),
           "surface of the endocardium, open at the base or closed there by a flat lid: .stl, "
           ".ply, .obj, .vtp or .vtk; names are relative to the case file"),
      file(LV_NAMED(anatomy.surfaces.epi), "surface of the epicardium, likewise"),
      number("anatomy.surfaces.length_unit", LV_AT(anatomy.surfaces.unit), "mm",
             between(0.0, 1000.0), "length of the files' unit, which they do not state"),
      choice(LV_NAMED(anatomy.surfaces.space), "stated LPS RAS",
             "space of the coordinates: as the files state it (SPACE=RAS, SPACE=LPS), or one "
             "for files that do not")}},
    {Stages(Stage::anatomy),
     {&from_guide_points},
     {file(LV_NAMED(anatomy.guide_points.file),
           "tab-separated list with columns x, y, z, contour type, slice and time frame"),
      number(LV_NAMED(anatomy.guide_points.frame), "", between(-1, 100000),
             "time frame to use; -1: the only one"),
      choice(LV_NAMED(anatomy.guide_points.apex_point), "endo epi",
             "the surface whose tip a point of type APEX_POINT is")}},
    {Stages(Stage::anatomy),
     {&from_mesh},
     {file("anatomy.mesh.file", LV_AT(anatomy.mesh.import.file),
           "mesh of hexahedra or tetrahedra: ABAQUS .inp, Gmsh .msh, .vtk or .vtu; names are "
           "relative to the case file"),
      number("anatomy.mesh.length_unit", LV_AT(anatomy.mesh.import.unit), "mm", positive,
             "length of the file's unit"),
      choice("anatomy.mesh.sides", LV_AT(anatomy.mesh.import.sides), "tags geometry",
             "the sides of the wall are named by the file's tags, or found: the flat opening is "
             "the base, the inner of the other two the endocardium")}},
    {Stages(Stage::anatomy),
     {&from_mesh, &tagged},
     {perhaps_path("anatomy.mesh.endo", LV_AT(anatomy.mesh.import.endo),
                   "tag of the endocardium; with VTK also the .vtp file of its surface"),
      perhaps_path("anatomy.mesh.epi", LV_AT(anatomy.mesh.import.epi), "tag of the epicardium"),
      perhaps_path("anatomy.mesh.base", LV_AT(anatomy.mesh.import.base), "tag of the base"),
      value("anatomy.mesh.side_array", LV_AT(anatomy.mesh.import.side_array),
            "VTK: cell array with the sides' numbers on surface cells; empty: the tags name "
            "point arrays that are 1 on a side")}},
    {Stages(Stage::anatomy),
     {&from_mesh, &infarct_of_mesh},
     {value("anatomy.mesh.infarct_array", LV_AT(anatomy.mesh.import.infarct_array),
            "VTK: point array of M(X); empty: infarct, if the file has it")}},
    {Stages(Stage::anatomy),
     {&from_mesh},
     {number("anatomy.mesh.base_tolerance", LV_AT(anatomy.mesh.import.base_tolerance), "mm",
             between(0.0, 10.0), "largest distance of the base's nodes from their plane"),
      number(LV_NAMED(anatomy.mesh.refinements), "", between(0, 3),
             "how often every element is cut into eight"),
      perhaps_path(
          "anatomy.mesh.fibres", LV_AT(anatomy.mesh.import.fibres),
          "VTK: array of fibre directions, in cells or at points, or a .vtu file with the same "
          "cells and such an array (SimVascular's FIB_DIR); empty: the rule of [fibres]")}},
    {Stages(Stage::anatomy),
     {&from_mesh, &fibres_given},
     {perhaps_path(
         "anatomy.mesh.sheets", LV_AT(anatomy.mesh.import.sheets),
         "the same of sheet directions across the fibres; empty: the sheet angles of [fibres]")}}};

constexpr Group of_mesh[]{
    {meshing,
     {&meshed_here, &linear_elements},
     {number(LV_NAMED(mesh.edge_length), "mm", between(0.2, 10.0),
             "target length of element edges; below the box's mesh width for nodal coupling",
             "2.5"),
      number(LV_NAMED(mesh.layers), "", between(0, 40),
             "elements through the wall; 0: as edge_length asks")}},
    {meshing,
     {&static_engine},
     {number(LV_NAMED(quasi_static.order), "", between(1, 2),
             "2: quadratic elements, on a mesh of their own; 1: linear hexahedra on the "
             "immersed engine's mesh")}},
    {meshing,
     {&static_engine, &meshed_here, &quadratic_elements},
     {number(LV_NAMED(quasi_static.edge_length), "mm", between(0.5, 20.0),
             "target length of the edges of quadratic elements"),
      number(LV_NAMED(quasi_static.layers), "", between(0, 20),
             "quadratic elements through the wall; 0: as edge_length asks"),
      number(LV_NAMED(quasi_static.apex), "", between(0.1, 1.0),
             "length along the wall of quadratic elements next to the apex, as a fraction of "
             "that in an even mesh of as many elements; others are longer"),
      number(LV_NAMED(quasi_static.endocardium), "", between(0.1, 1.0),
             "the same through the wall, next to the endocardium")}},
    {Stages(Stage::mesh, Stage::calibrate, Stage::unload, Stage::beat),
     {&fibres_by_rule},
     {number(LV_NAMED(fibres.helix_endo), "deg", between(-90.0, 90.0),
             "helix angle at the endocardium; negative is a right-handed helix (the paper's sign)",
             "2.2"),
      number(LV_NAMED(fibres.helix_epi), "deg", between(-90.0, 90.0),
             "helix angle at the epicardium", "2.2")}},
    {Stages(Stage::mesh, Stage::calibrate, Stage::unload, Stage::beat),
     {&sheets_by_rule},
     {number(LV_NAMED(fibres.sheet_endo), "deg", between(-90.0, 90.0),
             "sheet angle at the endocardium", "2.2"),
      number(LV_NAMED(fibres.sheet_epi), "deg", between(-90.0, 90.0),
             "sheet angle at the epicardium", "2.2")}},
    {Stages(Stage::anatomy, Stage::mesh, Stage::calibrate, Stage::unload, Stage::beat),
     {},
     {remark_whether_set(Stages(Stage::anatomy, Stage::mesh),
                         number(LV_NAMED(regions.septum_angle), "deg", between(-360.0, 360.0),
                                "direction of the middle of the septum about the long axis, "
                                "from the model's x axis towards y",
                                "Fig. 3"))}},
    {meshing,
     {},
     {number(LV_NAMED(regions.slice_spacing), "mm", between(0.0, 50.0),
             "spacing of the seven slice planes from the base on; 0: the wall's length / 6.5",
             "Fig. 3")}},
    {mechanics,
     {&static_engine},
     {number("quasi_static.stabilisation", LV_AT(quasi_static.stabilisation.beta_s), "kPa",
             not_negative,
             "volumetric stiffness at every quadrature point, which keeps elements from "
             "buckling inside; zero at J = 1; of muscle stiffer than the paper's it is more, as "
             "a exp(0.25 b) of holzapfel_ogden"),
      number("quasi_static.first_step", LV_AT(quasi_static.solver.first_step), "",
             between(1e-3, 1.0), "first load step, as a share of the whole load"),
      choice("quasi_static.linear_solver", LV_AT(quasi_static.solver.newton.linear.method),
             "direct iterative",
             "how the linear equations are solved: by MUMPS, or by GMRES with multigrid, for "
             "meshes whose factors do not fit into memory (quadratic elements alone)")}},
    {mechanics,
     {&static_engine, &iterative},
     {number("quasi_static.linear_tolerance", LV_AT(quasi_static.solver.newton.linear.tolerance),
             "", between(1e-14, 1e-2), "of the iterative solver: residual over right-hand side")}},
    {mechanics,
     {&static_engine},
     {number("quasi_static.tolerance", LV_AT(quasi_static.solver.newton.tolerance), "mm",
             between(1e-12, 0.1),
             "Newton's method ends when its correction moves the wall by less, rms")}}};

constexpr Group of_infarct[]{
    {Stages(Stage::anatomy, Stage::mesh, Stage::calibrate, Stage::unload),
     {},
     {choice("infarct.source", LV_AT(scar.source),
             "mesh none described elements surface labels strain lge",
             "where the infarct comes from: the mesh file's point array of M (no infarct if it has "
             "none), nowhere, or one of the tables below; an element is infarcted if its centre is",
             "2.11")}},
    {meshing,
     {&infarct_laid_on},
     {number("infarct.border", LV_AT(scar.border), "mm", above_up_to(0.0, 100.0),
             "width of the border zone, over which M falls from 1 to 0", "2.11")}},
    {meshing,
     {&infarct_without_unit},
     {number("infarct.length_unit", LV_AT(scar.length_unit), "mm", positive,
             "length of the unit of surface.file or labels.file")}},
    {meshing,
     {&infarct_of_images},
     {number("infarct.shift", LV_AT(scar.shift), "mm", between(-50.0, 50.0),
             "by which the labels or the late-enhancement image are moved in scanner "
             "coordinates before they are laid on the wall")}},
    {meshing,
     {&infarct_described},
     {number("infarct.described.angle", LV_AT(scar.described.angle), "deg", between(-360.0, 360.0),
             "direction of the sector's middle about the long axis, from the middle of the "
             "septum towards the anterior wall; 30 deg is antero-septal",
             "2.2"),
      number("infarct.described.width", LV_AT(scar.described.width), "deg", between(0.0, 360.0),
             "angle that the sector spans"),
      number("infarct.described.bottom", LV_AT(scar.described.bottom), "", between(0.0, 1.0),
             "height at which the sector begins, from 0 at the apex to 1 at the base"),
      number("infarct.described.top", LV_AT(scar.described.top), "", between(0.0, 1.0),
             "height at which the sector ends"),
      number("infarct.described.apex", LV_AT(scar.described.apex), "", between(0.0, 1.0),
             "below this height the wall is infarcted all round"),
      number("infarct.described.transmurality", LV_AT(scar.described.transmurality), "",
             above_up_to(0.0, 1.0),
             "part of the wall's thickness that is infarcted, from the endocardium")}},
    {Stages(Stage::anatomy, Stage::mesh, Stage::calibrate, Stage::unload),
     {&infarct_of_elements},
     {value("infarct.elements.set", LV_AT(scar.set),
            "set of elements in anatomy.mesh.file: an ABAQUS *Elset, the name or number of a "
            "Gmsh physical volume, or a VTK cell array that is 1 in the infarct and less "
            "elsewhere (border zone, made anew by infarct.border, and healthy muscle)")}},
    {meshing,
     {&infarct_of_surface},
     {file("infarct.surface.file", LV_AT(scar.surface),
           "closed surface in image space (a mesh's own coordinates): .stl, .ply, .obj, .vtp or "
           ".vtk; names are relative to the case file")}},
    {meshing,
     {&infarct_of_labels},
     {file("infarct.labels.file", LV_AT(scar.labels),
           "labelled volume in image space: NIfTI (.nii, .nii.gz, .hdr with .img), NRRD, "
           "MetaImage, .vti or .vtk (structured points)")}},
    {meshing,
     {&infarct_of_labels, &labels_in_vtk},
     {value("infarct.labels.array", LV_AT(scar.array),
            "array of labels, at points (centres of voxels) or in cells; empty: the only one")}},
    {meshing,
     {&infarct_of_labels},
     {filled_list("infarct.labels.scar", LV_AT(scar.scar), "the labels that mean scar")}},
    {meshing,
     {&infarct_of_labels, &labels_in_image},
     {number("infarct.labels.frame", LV_AT(scar.frame), "", between(0, 10000),
             "time of a map of several, counted from 1; 0: the only one that shows scar")}},
    {meshing,
     {&infarct_of_labels},
     {value("infarct.labels.no_reflow", LV_AT(scar.no_reflow),
            "the labels of the scar's dark core, which is infarct too")}},
    {meshing,
     {&infarct_of_labels, &moved_labels},
     {value("infarct.labels.muscle", LV_AT(scar.muscle),
            "the labels of the other muscle, for in_plane")}},
    {meshing,
     {&infarct_of_labels, &labels_in_image},
     {value("infarct.labels.in_plane", LV_AT(scar.in_plane),
            "move each slice in its plane until the middle of its muscle and scar lies on that "
            "of the wall there (another breath-hold)")}},
    {meshing,
     {&infarct_of_strain},
     {file("infarct.strain.file", LV_AT(scar_strain.file),
           "CSV of circumferential strains at end-systole from end-diastole with the columns of "
           "calibrate.strains, where there is no late enhancement: parts that shorten by less "
           "than the threshold are the infarct"),
      choice("infarct.strain.measure", LV_AT(scar_strain.measure), "green_lagrange engineering",
             "what that file holds: (lambda^2 - 1)/2 or lambda - 1"),
      number("infarct.strain.threshold", LV_AT(scar_strain.threshold), "", between(-0.3, 0.1),
             "lambda - 1 above which a part is infarcted (docs/infarct.md says whose it is)"),
      number("infarct.strain.error", LV_AT(scar_strain.error), "", between(0.0, 0.2),
             "standard deviation of those strains: parts nearer to the threshold are named as "
             "undecided")}},
    {meshing,
     {&infarct_of_lge},
     {path("infarct.lge.image", LV_AT(scar.lge.image),
           "late-enhancement image: a NIfTI, NRRD or MetaImage file or a folder of DICOM files; "
           "linear between pixels and between slices")}},
    {meshing,
     {&infarct_of_lge, &lge_in_dicom},
     {value("infarct.lge.series", LV_AT(scar.lge.series),
            "DICOM series to use, as `ventricle images` lists them; may be left out if there is "
            "one")}},
    {meshing,
     {&infarct_of_lge},
     {file("infarct.lge.drawn", LV_AT(scar.lge.drawn),
           "CSV of the scar's pixels on this image, as ventricle draw saves it (scar.csv): "
           "taken instead of what a threshold finds"),
      choice("infarct.lge.threshold", LV_AT(scar.lge.threshold), "sd fwhm",
             "scar is brighter than remote muscle by so many standard deviations, or than half "
             "way from no signal to the brightest in the wall")}},
    {meshing,
     {&infarct_of_lge, &threshold_sd},
     {number("infarct.lge.deviations", LV_AT(scar.lge.deviations), "", positive,
             "standard deviations above the mean of remote muscle (threshold = \"sd\")"),
      value("infarct.lge.remote", LV_AT(scar.lge.remote),
            "AHA segments (1 to 17) of remote, healthy muscle (threshold = \"sd\")")}},
    {meshing,
     {&infarct_of_lge, &threshold_fwhm},
     {whether_set(number("infarct.lge.zero", LV_AT(scar.lge.zero), "", any,
                         "grey value of no signal (threshold = \"fwhm\"): that of air, where "
                         "the image has an offset, as phase-sensitive reconstructions do"))}},
    {meshing,
     {&infarct_of_lge},
     {number("infarct.lge.largest_part", LV_AT(scar.lge.largest_part), "", between(0.0, 1.0),
             "of the wall that may be scar; more is refused, for it is rarely meant"),
      value("infarct.lge.fill_no_reflow", LV_AT(scar.lge.fill_no_reflow),
            "dark parts of the wall that the scar shuts off from epicardium and base count to it"),
      value("infarct.lge.in_plane", LV_AT(scar.lge.in_plane),
            "move each slice in its plane to where its grey values fit best to cavity, wall and "
            "surroundings (another breath-hold); where they do not show that clearly it stays, "
            "with a warning")}},
    {meshing,
     {&infarct_of_lge, &moved_lge},
     {number("infarct.lge.largest_shift", LV_AT(scar.lge.largest_shift), "mm",
             above_up_to(0.0, 50.0), "moves up to this one are tried (in_plane)")}},
    {mechanics,
     {&infarcted},
     {number(LV_NAMED(infarct.stiffening), "", between(0.0, 1e6),
             "an infarct of extent M is (1 + stiffening M) times as stiff", "2.23")}}};

// Of muscle: wide enough for any experiment, from gel to tendon (1 GPa), with exponents and
// tensions far beyond all that were ever fitted; finite, so that a slip of digits or units is told
// here and not by an exponential that overflows.
constexpr Range of_stiffness = above_up_to(0.0, 1e6);  // [kPa]
constexpr Range of_perhaps_stiffness = between(0.0, 1e6);
constexpr Range of_exponent = above_up_to(0.0, 1e3);
constexpr Range of_perhaps_exponent = between(0.0, 1e3);
constexpr Range of_stiffness_factor = above_up_to(0.0, 1e4);
constexpr Range of_tension = between(0.0, 1e4);  // [kPa]

constexpr Group of_muscle[]{
    {mechanics,
     {},
     {choice(LV_NAMED(passive.law), "holzapfel_ogden guccione neo_hookean",
             "passive law of the muscle", "2.14")}},
    {mechanics,
     {&holzapfel_ogden},
     {number(LV_NAMED(passive.C_a), "", of_stiffness_factor, "factor of a_f, a_s and a_fs", "2.25"),
      number(LV_NAMED(passive.holzapfel_ogden.a), "kPa", of_stiffness, "isotropic stiffness",
             "2.14"),
      number(LV_NAMED(passive.holzapfel_ogden.b), "", of_exponent, "isotropic exponent", "2.14"),
      number(LV_NAMED(passive.holzapfel_ogden.a_f), "kPa", of_perhaps_stiffness, "fibre stiffness",
             "2.14"),
      number(LV_NAMED(passive.holzapfel_ogden.b_f), "", of_exponent, "fibre exponent", "2.14"),
      number(LV_NAMED(passive.holzapfel_ogden.a_s), "kPa", of_perhaps_stiffness, "sheet stiffness",
             "2.14"),
      number(LV_NAMED(passive.holzapfel_ogden.b_s), "", of_exponent, "sheet exponent", "2.14"),
      number(LV_NAMED(passive.holzapfel_ogden.a_fs), "kPa", of_perhaps_stiffness,
             "fibre-sheet shear stiffness", "2.14"),
      number(LV_NAMED(passive.holzapfel_ogden.b_fs), "", of_exponent, "fibre-sheet shear exponent",
             "2.14")}},
    {mechanics,
     {&guccione},
     {number(LV_NAMED(passive.guccione.C), "kPa", of_stiffness, "overall stiffness"),
      number(LV_NAMED(passive.guccione.b_f), "", of_perhaps_exponent, "exponent along the fibre"),
      number(LV_NAMED(passive.guccione.b_t), "", of_perhaps_exponent, "exponent across the fibre"),
      number(LV_NAMED(passive.guccione.b_fs), "", of_perhaps_exponent,
             "exponent of fibre-cross-fibre shear")}},
    {mechanics,
     {&neo_hookean},
     {number(LV_NAMED(passive.neo_hookean.mu), "kPa", of_stiffness, "shear modulus")}},
    {Stages(Stage::beat),
     {&immersed_engine},
     {number(LV_NAMED(volumetric.beta_s), "kPa", not_negative,
             "penalty that reinforces incompressibility; the paper: 100 kPa", "2.20"),
      choice("volumetric.points", LV_AT(volumetric_points), "full mean",
             "where the penalty is integrated: at all points of an element, or from mean "
             "dilatations (of a hexahedron, around a node of tetrahedra), which do not lock",
             "2.20")}},
    {Stages(Stage::beat),
     {&immersed_engine, &heartbeats, &mean_dilatations},
     {number("volumetric.stabilisation", LV_AT(stabilisation.beta_s), "kPa", not_negative,
             "penalty at every quadrature point besides, which keeps elements from bending "
             "under beat after beat; zero at J = 1. A tetrahedron keeps at least a tenth of "
             "beta_s to itself")}},
    {mechanics,
     {},
     {choice("active.law", LV_AT(active_law), "niederer second_piola cauchy land2017",
             "active tension of Niederer, Hunter and Smith (rat, room temperature) or of Land et "
             "al. 2017 (human, 37 degrees), J T F f0 (x) f0; or a prescribed tension as the second "
             "Piola-Kirchhoff stress T f0 (x) f0, or as the Cauchy stress T along the fibre",
             "2.21")}},
    {mechanics,
     {&prescribed_tension},
     {number("active.tension", LV_AT(prescribed_tension), "kPa", of_tension,
             "prescribed tension at end-systole (laws second_piola and cauchy)")}},
    {mechanics,
     {&niederer},
     {number(LV_NAMED(active.T_scale), "", between(0.0, 1e3),
             "strength of contraction, T_ref = T_scale x T_ref_unscaled", "A"),
      number(LV_NAMED(active.T_ref_unscaled), "kPa", above_up_to(0.0, 1e4),
             "tension at full activation and resting length for T_scale = 1", "A")}},
    {mechanics,
     {&niederer, &moving_fibres},
     {number(LV_NAMED(active.a), "", not_negative, "curvature of the force-velocity relation",
             "A.10")}},
    {beating,
     {&niederer, &moving_fibres},
     {number("active.A_1", LV_AT(active.A[0]), "", any, "weight of a fading memory", "A.11"),
      number("active.alpha_1", LV_AT(active.alpha[0]), "1/s", positive, "rate of a fading memory",
             "A.11"),
      number("active.A_2", LV_AT(active.A[1]), "", any, "weight of a fading memory", "A.11"),
      number("active.alpha_2", LV_AT(active.alpha[1]), "1/s", positive, "rate of a fading memory",
             "A.11"),
      number("active.A_3", LV_AT(active.A[2]), "", any, "weight of a fading memory", "A.11"),
      number("active.alpha_3", LV_AT(active.alpha[2]), "1/s", positive, "rate of a fading memory",
             "A.11")}},
    {mechanics,
     {&niederer},
     {number(LV_NAMED(active.alpha_0), "1/s", positive, "rate of activation of actin sites", "A.4"),
      number(LV_NAMED(active.alpha_r1), "1/s", positive, "slow rate of relaxation", "A.4"),
      number(LV_NAMED(active.alpha_r2), "1/s", positive, "fast rate of relaxation", "A.4"),
      number(LV_NAMED(active.beta_0), "", any, "dependence of the isometric tension on stretch",
             "A.6"),
      number(LV_NAMED(active.beta_1), "", any, "dependence of the calcium sensitivity on stretch",
             "A.5"),
      number(LV_NAMED(active.Ca_50ref), "uM", positive,
             "calcium at half activation at resting length", "A.5"),
      number(LV_NAMED(active.Ca_trpn_max), "uM", positive, "binding sites on troponin", "A.2"),
      number(LV_NAMED(active.gamma), "", positive, "how much tension slows unbinding", "A.3"),
      number(LV_NAMED(active.k_on), "1/(uM s)", positive, "rate of binding", "A.2"),
      number(LV_NAMED(active.k_off_ref), "1/s", positive, "rate of unbinding without tension",
             "A.3"),
      number(LV_NAMED(active.K_z), "", positive, "half point of fast relaxation", "A.4"),
      number(LV_NAMED(active.z_p), "", positive, "point of linearisation of fast relaxation",
             "A.8"),
      number(LV_NAMED(active.stretch_min), "", between(0.1, 1.0),
             "guard: smallest stretch that (A.5)-(A.7) are given", "A.5"),
      number(LV_NAMED(active.stretch_max), "", between(1.0, 1.24),
             "guard: largest stretch that (A.5)-(A.7) are given", "A.5"),
      number(LV_NAMED(active.unbinding_min), "", between(0.0, 1.0),
             "guard: least value of the bracket in (A.3)", "A.3")}},
    {mechanics,
     {&land2017},
     {number("active.land2017.T_ref", LV_AT(land2017.T_ref), "kPa", of_tension,
             "tension at full activation and resting length"),
      number("active.land2017.Ca_50ref", LV_AT(land2017.Ca_50ref), "uM", positive,
             "calcium at half saturation of troponin at resting length"),
      number("active.land2017.beta_0", LV_AT(land2017.beta_0), "", not_negative,
             "dependence of the overlap on stretch"),
      number("active.land2017.beta_1", LV_AT(land2017.beta_1), "uM", any,
             "change of the calcium at half saturation with stretch"),
      number("active.land2017.TRPN_50", LV_AT(land2017.TRPN_50), "", between(0.01, 1.0),
             "share of troponin with calcium at which half of the sites are blocked"),
      number("active.land2017.r_s", LV_AT(land2017.r_s), "", between(0.01, 0.99),
             "share of cross-bridges after the power stroke at full activation"),
      number("active.land2017.r_w", LV_AT(land2017.r_w), "", between(0.01, 0.99),
             "share of the other cross-bridges that is before it")}},
    {beating,
     {&land2017, &moving_fibres},
     {number("active.land2017.k_TRPN", LV_AT(land2017.k_TRPN), "1/s", positive,
             "rate of calcium's binding to troponin"),
      number("active.land2017.k_u", LV_AT(land2017.k_u), "1/s", positive,
             "rate of unblocking of actin sites"),
      number("active.land2017.k_uw", LV_AT(land2017.k_uw), "1/s", positive,
             "rate from unbound to before the power stroke"),
      number("active.land2017.k_ws", LV_AT(land2017.k_ws), "1/s", positive,
             "rate of the power stroke"),
      number("active.land2017.gamma_s", LV_AT(land2017.gamma_s), "1/s", not_negative,
             "distortion unbinds cross-bridges after the power stroke"),
      number("active.land2017.gamma_w", LV_AT(land2017.gamma_w), "1/s", not_negative,
             "distortion unbinds cross-bridges before it"),
      number("active.land2017.phi", LV_AT(land2017.phi), "", positive,
             "how fast distortion decays"),
      number("active.land2017.A_eff", LV_AT(land2017.A_eff), "", not_negative,
             "distortion per stretch")}},
    {Stages(Stage::beat),
     {&immersed_engine, &paper_protocol},
     {choice("calcium.mode", LV_AT(protocol.calcium.mode), "hold transient",
             "calcium stays at its peak until the ventricle is steady, or decays as its shape says",
             "A.1")}},
    {beating,
     {&calcium_in_time},
     {choice("calcium.shape", LV_AT(protocol.calcium.shape), "alpha_function double_exponential",
             "Ca_0 + (Ca_max - Ca_0) times t/tau exp(1 - t/tau), or a difference of exponentials "
             "with time constants t_1 and t_2, as human transients have been described",
             "A.1")}},
    {mechanics,
     {&calcium_counts},
     {number("calcium.Ca_0", LV_AT(protocol.calcium.Ca_0), "uM", not_negative, "resting calcium",
             "A.1"),
      number("calcium.Ca_max", LV_AT(protocol.calcium.Ca_max), "uM", positive, "peak calcium",
             "A.1")}},
    {beating,
     {&calcium_in_time, &alpha_function},
     {number("calcium.tau", LV_AT(protocol.calcium.tau), "s", positive, "time to the peak",
             "A.1")}},
    {beating,
     {&calcium_in_time, &double_exponential},
     {number("calcium.t_1", LV_AT(protocol.calcium.t_1), "s", positive,
             "time constant of the rise"),
      number("calcium.t_2", LV_AT(protocol.calcium.t_2), "s", positive,
             "time constant of the decay, longer than t_1")}}};

constexpr Group of_blood_and_base[]{
    {mechanics,
     {},
     {file("muscle.contractility", LV_AT(contractility_file),
           "CSV with the columns segment (1 to 17 of the American Heart Association) and factor, "
           "by which the active tension of that segment is multiplied, whatever the law, engine "
           "and protocol; between segments it passes over the nodes of one element; empty: 1")}},
    {Stages(Stage::mesh, Stage::calibrate, Stage::unload, Stage::beat, Stage::results),
     {&mass_counts},
     {number("muscle.density", LV_AT(muscle_density), "g/ml", positive,
             "density of the muscle: mass = density x volume; 1.05 g/ml is the clinical "
             "convention. The motion goes by it with cycle.inertia, and by blood.density in the "
             "immersed engine")}},
    {mechanics,
     {&static_beat, &static_rates},
     {number("muscle.viscosity", LV_AT(viscosity.eta), "kPa s", not_negative,
             "eta of the viscous stress S = eta dE/dt, E the Green-Lagrange strain")}},
    {mechanics,
     {&static_beat},
     {number("volumetric.bulk_modulus", LV_AT(bulk_modulus), "kPa", not_negative,
             "kappa of the energy kappa/4 (J^2 - 1 - 2 ln J); 0: the wall is incompressible")}},
    {Stages(Stage::beat),
     {&immersed_engine},
     {number(LV_NAMED(blood.density), "g/ml", positive,
             "density of blood and muscle in their motion", "2.1"),
      number(LV_NAMED(blood.viscosity), "cP", not_negative,
             "viscosity of blood and muscle; the paper prints 0.04 cP, a slip for 0.04 P", "2.1"),
      number(LV_NAMED(box.size), "mm", between(10.0, 1000.0),
             "size of the box around the ventricle", "2.5"),
      number(LV_NAMED(box.cells), "", between(8, 2048), "cells of the box along x, y and z", "2.5"),
      choice(LV_NAMED(coupling.kind), "nodal quadrature",
             "forces and velocities pass between wall and grid at the nodes, or at Gauss points "
             "made anew every step (the paper's scheme, several times slower)",
             "2.9"),
      choice(LV_NAMED(coupling.kernel), "peskin4 composite_bspline",
             "regularised delta function: the paper's 4-point kernel, or B-splines that keep "
             "the wall's velocity divergence-free",
             "2.5")}},
    {Stages(Stage::beat),
     {&immersed_engine, &quadrature},
     {number(LV_NAMED(coupling.points_per_cell), "", between(0.5, 8.0),
             "Gauss points per mesh width (quadrature coupling)", "2.5")}},
    {mechanics,
     {},
     {choice("base.support", LV_AT(base.kind), "sliding fixed elastic",
             "the basal plane is held along the axis and around it and moves freely outwards, "
             "or is held altogether; or springs and dashpots of the case hold it",
             "2.4")}},
    {Stages(Stage::beat),
     {&immersed_engine, &rigid_base},
     {number(LV_NAMED(base.stiffness), "kPa/mm", positive,
             "springs per area that hold the basal plane (immersed engine; the quasi-static "
             "engine holds it rigidly)",
             "2.4")}},
    {mechanics,
     {&elastic_base},
     {number("base.normal_stiffness", LV_AT(surroundings.base.normal_stiffness), "kPa/mm",
             not_negative, "springs per area along the normal of the undeformed base"),
      number("base.tangential_stiffness", LV_AT(surroundings.base.tangential_stiffness), "kPa/mm",
             not_negative, "springs per area in its plane")}},
    {mechanics,
     {&elastic_base, &rates},
     {number("base.normal_viscosity", LV_AT(surroundings.base.normal_viscosity), "kPa s/mm",
             not_negative, "dashpots per area along the normal of the undeformed base"),
      number("base.tangential_viscosity", LV_AT(surroundings.base.tangential_viscosity), "kPa s/mm",
             not_negative, "dashpots per area in its plane")}},
    {beating,
     {&beats_of_moving_base},
     {choice("base.motion", LV_AT(base_motion.source), "none table cine",
             "the base stays, or its springs and dashpots move with it through every beat: as a "
             "table says, or as strain.long_axis_cine shows")}},
    {beating,
     {&beats_of_moving_base, &base_table},
     {file("base.motion_file", LV_AT(base_motion.file),
           "CSV with the columns time_s (after the calcium of a beat begins) or cycle_share, "
           "axial_mm (towards the apex), septal_tilt_deg, anterior_tilt_deg (that edge towards "
           "the apex) and rotation_deg (anticlockwise seen from the apex)")}},
    {beating,
     {&beats_of_moving_base, &moving_base},
     {number("base.motion_zero", LV_AT(base_motion.zero), "s", not_negative,
             "time of the motion at which the base is where the wall without load has it: the "
             "moment of the cycle at which its shape was seen")}},
    {mechanics,
     {},
     {number("pericardium.normal_stiffness", LV_AT(surroundings.epicardium.normal_stiffness),
             "kPa/mm", not_negative,
             "springs per area along the normal of the undeformed epicardium"),
      number("pericardium.tangential_stiffness",
             LV_AT(surroundings.epicardium.tangential_stiffness), "kPa/mm", not_negative,
             "springs per area in its tangential plane")}},
    {mechanics,
     {&rates},
     {number("pericardium.normal_viscosity", LV_AT(surroundings.epicardium.normal_viscosity),
             "kPa s/mm", not_negative,
             "dashpots per area along the normal of the undeformed epicardium"),
      number("pericardium.tangential_viscosity",
             LV_AT(surroundings.epicardium.tangential_viscosity), "kPa s/mm", not_negative,
             "dashpots per area in its tangential plane")}},
    {mechanics,
     {&pericardium},
     {choice("pericardium.weight", LV_AT(surroundings.epicardium.weight.shape),
             "even linear sigmoid",
             "springs and dashpots are the same everywhere, or times w = weight_base + (1 - "
             "weight_base) s at the height h, from 0 at the apex to 1 at the base: s = 1 - h, "
             "or s = 1/(1 + exp(weight_steepness (h - weight_middle)))")}},
    {mechanics,
     {&pericardium, &weighted_pericardium},
     {number("pericardium.weight_base", LV_AT(surroundings.epicardium.weight.at_base), "",
             not_negative, "see weight")}},
    {mechanics,
     {&pericardium, &sigmoid_pericardium},
     {number("pericardium.weight_middle", LV_AT(surroundings.epicardium.weight.middle), "",
             between(0.0, 1.0), "see weight; the default is that of pyansys-heart"),
      number("pericardium.weight_steepness", LV_AT(surroundings.epicardium.weight.steepness), "",
             positive, "see weight; the default is that of pyansys-heart")}},
    {mechanics,
     {&static_beat, &no_beats},
     {number("septum.pressure_share", LV_AT(septal_pressure), "", between(0.0, 1.0),
             "pressure of the right ventricle on the septum, as a part of the cavity's: on the "
             "epicardium of the AHA segments 2, 3, 8, 9 and 14, between the insertions; 0: none "
             "(in healthy people about 0.2 at end-systole, 0.5 at end-diastole)")}}};

constexpr Group of_measurements[]{
    {mechanics,
     {},
     {choice("calibrate.passive", LV_AT(calibration.passive),
             "none C_a scale scale_and_exponent klotz",
             "what is fitted to edv: C_a; a factor of a, a_f, a_s and a_fs; or that and a "
             "factor of the exponents b, to the Klotz curve besides. klotz: both factors and "
             "the wall without load from the shape of end-diastole and its pressure alone, to "
             "the unloaded volume and filling curve by Klotz et al.",
             "2.25"),
      value("calibrate.active", LV_AT(calibration.active),
            "whether active.T_scale is fitted to esv")}},
    {beating,
     {&heartbeats},
     {value("calibrate.cycle", LV_AT(calibration.cycle),
            "whether heartbeats are fitted to edv, esv, cuff_systolic and cuff_diastolic, those "
            "that are set: the pressure that fills the heart, contractility, resistance and "
            "compliance of the arteries; circulation.period is the measured one")}},
    {Stages(Stage::calibrate),
     {&klotz_fit},
     {number("calibrate.pressure_error", LV_AT(calibration.pressure_error), "mmHg",
             between(0.0, 20.0),
             "by which unloaded.pressure, which few have measured, may be off: the fit is made "
             "again with as much less and more, for the interval that this leaves; 0 mmHg: not; "
             "where it is not set, at most half of unloaded.pressure")}},
    {Stages(Stage::calibrate),
     {&edv_fit},
     {number("calibrate.edv", LV_AT(calibration.edv), "ml", between(0.0, 2000.0),
             "measured volume at protocol.ed_pressure, and of heartbeats at the closing of the "
             "mitral valve; 0: none",
             "3.1")}},
    {Stages(Stage::calibrate),
     {&esv_fit},
     {number("calibrate.esv", LV_AT(calibration.esv), "ml", between(0.0, 2000.0),
             "measured volume at protocol.es_pressure, or of heartbeats at the closing of the "
             "aortic valve; 0: none",
             "3.1")}},
    {Stages(Stage::calibrate),
     {&fit_to_beats},
     {number("calibrate.cuff_systolic", LV_AT(calibration.cuff_systolic), "mmHg",
             between(0.0, 400.0),
             "systolic pressure of a cuff on the arm, taken for the aorta's largest; 0: none"),
      number("calibrate.cuff_diastolic", LV_AT(calibration.cuff_diastolic), "mmHg",
             between(0.0, 400.0),
             "diastolic pressure of a cuff on the arm, taken for the aorta's least; 0: none"),
      number("calibrate.factor_min", LV_AT(calibration.factor.low), "", positive,
             "least value of what is fitted to heartbeats, to that of the case"),
      number("calibrate.factor_max", LV_AT(calibration.factor.high), "", positive,
             "largest value of it")}},
    {Stages(Stage::calibrate, Stage::beat),
     {&fit},
     {number("calibrate.tolerance", LV_AT(calibration.tolerance), "", between(1e-5, 0.5),
             "volumes, and pressures of heartbeats, of the fitted model are right within this "
             "fraction; the paper: 0.05",
             "3.1")}},
    {Stages(Stage::calibrate),
     {&passive_fit},
     {number("calibrate.stiffness_min", LV_AT(calibration.stiffness.low), "", positive,
             "least C_a or factor"),
      number("calibrate.stiffness_max", LV_AT(calibration.stiffness.high), "", positive,
             "largest C_a or factor")}},
    {Stages(Stage::calibrate),
     {&exponent_fit},
     {number("calibrate.exponent_min", LV_AT(calibration.exponent.low), "", positive,
             "least factor of the b"),
      number("calibrate.exponent_max", LV_AT(calibration.exponent.high), "", positive,
             "largest factor of the b")}},
    {Stages(Stage::calibrate),
     {&active_fit},
     {number("calibrate.T_scale_min", LV_AT(calibration.T_scale.low), "", positive,
             "least T_scale"),
      number("calibrate.T_scale_max", LV_AT(calibration.T_scale.high), "", positive,
             "largest T_scale"),
      file("calibrate.strains", LV_AT(calibration.strains),
           "CSV of circumferential strains at end-systole from end-diastole, fitted to besides "
           "the volumes, with columns slice (1 at the base to 7, or aha), segment (ant, "
           "antsept, ..., or 1 to 17) and strain; empty: none"),
      value("calibrate.shape", LV_AT(calibration.shape),
            "whether the surfaces that the anatomy's source shows at end-systole are fitted to "
            "besides the volumes: the mean distance of every sector of 60 degrees of every "
            "drawn loop, when all loops are moved along the long axis to where they fit best")}},
    {Stages(Stage::calibrate),
     {&strains_given},
     {choice("calibrate.strain_measure", LV_AT(calibration.strain_measure),
             "green_lagrange engineering", "what that file holds: (lambda^2 - 1)/2 or lambda - 1"),
      number("calibrate.strain_error", LV_AT(calibration.errors.strain), "", above_up_to(0.0, 1.0),
             "standard deviation of those strains: each weighs 1/strain_error")}},
    {Stages(Stage::calibrate),
     {&shape_fit},
     {number("calibrate.shape_error", LV_AT(calibration.errors.shape), "mm",
             above_up_to(0.0, 100.0),
             "standard deviation of those distances: each weighs 1/shape_error; the default is "
             "about as far as borders of end-systole by two hands lie from each other")}},
    {Stages(Stage::calibrate),
     {&fit_to_regions},
     {number("calibrate.volume_error", LV_AT(calibration.errors.volume), "", above_up_to(0.0, 1.0),
             "standard deviation of the volumes, as a fraction, where strains or a shape are "
             "fitted besides")}},
    {mechanics,
     {&strains_given},
     {choice("calibrate.contractility", LV_AT(calibration.contractility), "even segments",
             "segments: a factor of contractility of each AHA segment that has a strain is "
             "fitted besides, with its uncertainty (contractility.csv)")}},
    {Stages(Stage::calibrate),
     {&strains_given, &segments_fitted},
     {number("calibrate.contractility_spread", LV_AT(calibration.contractility_spread), "",
             between(0.01, 3.0),
             "standard deviation that ln(factor) of segments has before anything is measured: "
             "(ln factor/spread)^2 is a penalty against noise")}},
    {Stages(Stage::beat),
     {&fit, &immersed_engine},
     {value("calibrate.confirm", LV_AT(calibration.confirm),
            "if the immersed engine's volumes are off by more than the tolerance, correct the "
            "parameters and run the beat again, at most twice")}},
    {Stages(Stage::anatomy, Stage::calibrate, Stage::unload, Stage::beat),  // the first warns
     {},
     {number(LV_NAMED(unloaded.pressure), "mmHg", between(0.0, 100.0),
             "pressure under which the shape of the anatomy was seen; the wall without load is "
             "found from it before the beat. 0: that shape is free of stress, as in the paper",
             "4")}},
    {Stages(Stage::calibrate, Stage::unload),
     {&loaded},
     {number(LV_NAMED(unloaded.tolerance), "mm", above_up_to(0.0, 5.0),
             "largest distance of a node of the wall, loaded again, from where it was seen"),
      number(LV_NAMED(unloaded.near_enough), "mm", between(0.0, 2.0),
             "the same where the search comes no nearer: a wall without folds is then taken "
             "with a warning"),
      number(LV_NAMED(unloaded.iterations), "", between(1, 1000),
             "equilibria after which the search gives up"),
      number(LV_NAMED(unloaded.smooth_within), "mm", between(0.0, 10.0),
             "where the wall without load would be folded: a smooth one is taken that comes, "
             "loaded again, this near to where the wall was seen, rms; 0: none")}},
    {Stages(Stage::strain),
     {},
     {path(LV_NAMED(strain.cine),
           "short-axis cine that strain is measured from: a folder of DICOM files or a NIfTI, "
           "NRRD or MetaImage file over time; names are relative to the case file")}},
    {Stages(Stage::strain),
     {&cine},
     {value(LV_NAMED(strain.series),
            "DICOM: number, UID or description of the series; may be left out if there is one"),
      path(LV_NAMED(strain.contours),
           "loops of endocardium and epicardium drawn on the cine at end-diastole: a CSV file "
           "in the form of anatomy.contours.short_axis, or a folder of text contours in the "
           "Sunnybrook form"),
      file(LV_NAMED(strain.long_axis),
           "CSV of curves on long-axis images at end-diastole, for the place of the apex and to "
           "follow long_axis_cine; may be left out"),
      perhaps_path(LV_NAMED(strain.long_axis_cine),
                   "long-axis cines that show how far muscle moves through the short-axis "
                   "planes, with the curves of long_axis: files of images, or series of the "
                   "DICOM folder cine; [] leaves that motion unseen"),
      file(LV_NAMED(strain.es_contours),
           "CSV of loops drawn at end-systole, which the carried contours are compared with; "
           "may be left out"),
      number(LV_NAMED(strain.end_diastole), "", between(1, 1000),
             "which image of every slice, in order of time, the contours are drawn on"),
      number(LV_NAMED(strain.end_systole), "", between(0, 1000),
             "which image is end-systole; 0: the one with the smallest cavity"),
      number(LV_NAMED(strain.septum_point), "mm", any,
             "a point of the middle of the septum in scanner coordinates; none: that of "
             "anatomy.contours"),
      choice("strain.scheme", LV_AT(strain.registration.scheme), "direct incremental",
             "every image is matched with end-diastole, or with the one before it"),
      number("strain.knot_spacing", LV_AT(strain.registration.knot_spacing), "mm",
             between(2.0, 50.0), "of the B-spline map"),
      number("strain.bending", LV_AT(strain.registration.bending), "mm^2", between(0.0, 1e5),
             "weight of the map's bending energy against the images' difference"),
      number("strain.smoothing", LV_AT(strain.registration.smoothing), "mm", between(0.0, 10.0),
             "standard deviation of the Gaussian that images are smoothed with"),
      number("strain.margin", LV_AT(strain.registration.margin), "mm", between(0.0, 40.0),
             "pixels up to this distance outside the epicardium count")}},
    {Stages(Stage::results),
     {},
     {file(LV_NAMED(strain.measured),
           "CSV of measured strains to compare with, instead of images: slice (1 at the base, "
           "one per slice of the model), component (cir or rad), segment, and a column per "
           "image")}},
    {Stages(Stage::results),
     {&measured},
     {value(LV_NAMED(strain.measured_column), "the column of measured to take"),
      choice(LV_NAMED(strain.measured_kind), "green_lagrange engineering",
             "which strain measured holds: (l^2/L^2 - 1)/2 or l/L - 1")}}};

constexpr Range of_factor = between(0.1, 10.0);

/// What beats may still change by where they count as a limit cycle.
constexpr Range of_limit_cycle = between(0.0, 0.1);

/// No stage reads a study; the beats are those that it makes a family of.
constexpr Group of_study[]{
    {Stages(Stage::beat),
     {&heartbeats},
     {same_results(numbers(LV_NAMED(study.preload), of_factor,
                           "of what fills the ventricle: circulation.windkessel.p_ven, or the "
                           "blood of a closed loop, circulation.closed_loop.blood")),
      same_results(
          numbers(LV_NAMED(study.afterload), of_factor,
                  "of the resistance that it ejects against: circulation.windkessel.R_p or "
                  "circulation.closed_loop.systemic.R_ar")),
      same_results(numbers(LV_NAMED(study.contractility), of_factor,
                           "of the muscle's tension: active.land2017.T_ref or active.T_scale")),
      same_results(numbers(
          LV_NAMED(study.heart_rate), of_factor,
          "of beats per time, 1/circulation.period, with the times of chambers; calcium stays"))}}};

constexpr Group of_protocol[]{
    {beating,
     {&of_beats},
     {choice(LV_NAMED(protocol.kind), "paper cycle",
             "filling and contraction as in the paper; or heartbeats of the wall joined to the "
             "circulation",
             "2.4")}},
    {beating,
     {&heartbeats},
     {number("cycle.beats", LV_AT(protocol.cycle.beats), "", between(1, 1000), "beats at most"),
      number("cycle.tolerance", LV_AT(protocol.cycle.tolerance), "", of_limit_cycle,
             "beats end when the last has changed no state of the circuit, nor end-diastolic or "
             "end-systolic volume, by more than this part of itself, and those to come would "
             "add at most ten times as much; 0: never")}},
    {beating,
     {&heartbeats, &closed_loop},
     {value("cycle.leap", LV_AT(protocol.cycle.leap),
            "whether the loop's blood leaps between beats to where a stand-in for the wall that "
            "beats as the last beat did comes to; else beats follow each other as in a body, "
            "and take tens to their limit cycle")}},
    {beating,
     {&heartbeats, &static_beat},
     {number("cycle.step", LV_AT(protocol.cycle.step), "s", above_up_to(0.0, 0.02),
             "of time, at most; a step that fails is repeated shorter"),
      number("cycle.step_error", LV_AT(protocol.cycle.step_error), "", between(0.0, 0.1),
             "local error of a step in the cavity's volume and pressure, as a part of them; "
             "steps with more are repeated shorter; 0: all are cycle.step long"),
      value("cycle.inertia", LV_AT(protocol.cycle.inertia),
            "whether the wall has the mass of muscle.density; else it is in equilibrium at "
            "every time")}},
    {Stages(Stage::beat),
     {&heartbeats, &static_beat},
     {file("cycle.begin", LV_AT(protocol.cycle.begin),
           "03_beat/end_of_beats.bin of another run of this wall: beats begin where those "
           "ended, with this case's circulation and muscle, instead of with a filled wall; "
           "names are relative to the case file")}},
    {beating,
     {&heartbeats, &static_beat, &inertia},
     {number("cycle.spectral_radius", LV_AT(protocol.cycle.spectral_radius), "", between(0.0, 1.0),
             "of the generalised alpha rule, by which the fastest waves shrink in a step: 0 "
             "they vanish, 1 they stay")}},
    {beating,
     {&heartbeats},
     {choice(LV_NAMED(activation.kind), "uniform eikonal file",
             "calcium begins everywhere at once; where a front has come, which spreads by the "
             "eikonal equation; or at times of a file")}},
    {beating,
     {&heartbeats, &eikonal},
     {number("activation.v_f", LV_AT(activation.speeds.v_f), "m/s", positive,
             "speed of the front along the fibres; the three defaults are of five pigs: "
             "Caldwell et al., Circ. Arrhythm. Electrophysiol. 2:433, 2009"),
      number("activation.v_s", LV_AT(activation.speeds.v_s), "m/s", positive,
             "speed across the fibres in the sheets"),
      number("activation.v_n", LV_AT(activation.speeds.v_n), "m/s", positive,
             "speed along the sheets' normals"),
      number("activation.v_endocardium", LV_AT(activation.speeds.endocardium), "m/s", not_negative,
             "speed along the endocardial surface, which stands for the Purkinje network; 0: "
             "that of the muscle; the default is a choice"),
      filled_list(
          LV_NAMED(activation.sites),
          "where the front starts: segments (\"mid anterior\", \"apex\", or the AHA's number), "
          "whose middle on the endocardium is meant; points (\"12 -4 -30 mm\", in the "
          "coordinates of 02_mesh/mesh.vtu); or \"endocardium\", all of it. The default: "
          "segments nearest to those of Durrer et al., Circulation 41:899, 1970")}},
    {beating,
     {&heartbeats, &activation_file},
     {file(LV_NAMED(activation.file),
           "one time for each node or cell of 02_mesh/mesh.vtu, or each corner or element of a "
           "mesh that became quadratic: an array of a .vtu or .vtk file, or a text with one a "
           "line, as openCARP writes them; names are relative to the case file"),
      value(LV_NAMED(activation.array),
            "array of a VTK file; empty: the only one of single numbers"),
      number(LV_NAMED(activation.time_unit), "ms", positive, "duration of the file's unit")}},
    {Stages(Stage::calibrate, Stage::beat),
     {&paper_protocol},
     {number(LV_NAMED(protocol.ed_pressure), "mmHg", between(0.0, 500.0), "end-diastolic pressure",
             "2.4"),
      number(LV_NAMED(protocol.es_pressure), "mmHg", between(0.0, 500.0), "end-systolic pressure",
             "2.4"),
      number("protocol.cuff_systolic", LV_AT(cuff_systolic), "mmHg", between(0.0, 400.0),
             "systolic pressure of a cuff on the arm, in place of es_pressure, which is then "
             "taken to be 0.9 of it (Kelly et al., Circulation 86:513, 1992); 0: none")}},
    {Stages(Stage::beat),
     {&filled_in_time},
     {number(LV_NAMED(protocol.filling_ramp), "s", above_up_to(0.0, 100.0),
             "time in which the pressure rises to ed_pressure")}},
    {Stages(Stage::beat),
     {&immersed_engine},
     {number(LV_NAMED(protocol.filling_tolerance), "", between(1e-6, 0.5),
             "filling ends when the volume has varied by less than this fraction of itself over "
             "filling_window"),
      number(LV_NAMED(protocol.filling_window), "s", above_up_to(0.0, 100.0),
             "see filling_tolerance"),
      number(LV_NAMED(protocol.filling_longest), "s", above_up_to(0.0, 100.0),
             "filling ends after this time at the latest, with a warning"),
      number(LV_NAMED(protocol.filling_drag), "1/s", not_negative,
             "uniform resistance to the velocity once the pressure is constant; stops the "
             "ringing, moves no equilibrium")}},
    {Stages(Stage::beat),
     {&paper_protocol},
     {number(LV_NAMED(protocol.contraction_ramp), "s", above_up_to(0.0, 100.0),
             "time in which the pressure rises from ed_pressure to es_pressure")}},
    {Stages(Stage::beat),
     {&immersed_engine, &paper_protocol, &held_calcium},
     {number(LV_NAMED(protocol.contraction_tolerance), "", between(1e-6, 0.5),
             "with calcium held, contraction ends when the volume has varied by less than this "
             "fraction over contraction_window"),
      number(LV_NAMED(protocol.contraction_window), "s", above_up_to(0.0, 100.0),
             "see contraction_tolerance")}},
    {Stages(Stage::beat),
     {&immersed_engine, &paper_protocol},
     {number(LV_NAMED(protocol.contraction_longest), "s", above_up_to(0.0, 100.0),
             "contraction ends after this time at the latest, with a warning")}},
    {Stages(Stage::beat),
     {&immersed_engine, &paper_protocol, &held_calcium},
     {number(LV_NAMED(protocol.contraction_drag), "1/s", not_negative,
             "like filling_drag, once pressure and calcium are constant")}},
    {Stages(Stage::beat),
     {&immersed_engine},
     {number("time.longest_step", LV_AT(time.longest), "s", above_up_to(0.0, 0.01),
             "the time step, unless stability asks for less", "2.5"),
      number(LV_NAMED(time.courant), "", between(0.01, 1.0),
             "largest blood velocity x step / mesh width"),
      number(LV_NAMED(time.velocity_limit), "m/s", positive,
             "a step that makes the wall or the blood faster than this is taken back and "
             "repeated smaller"),
      number(LV_NAMED(time.halvings), "", between(0, heartbeat::most_halvings),
             "how often the step may be halved before the run gives up")}},
    {Stages(Stage::beat),
     {},
     {number(LV_NAMED(output.frame_interval), "s", positive,
             "simulated time between fields of wall and blood")}},
    {Stages(Stage::beat),
     {&immersed_engine},
     {number(LV_NAMED(output.curve_interval), "s", positive,
             "simulated time between rows of the curves"),
      value(LV_NAMED(output.blood), "whether frames contain velocity and pressure of the blood")}},
    {Stages(Stage::beat),
     {},
     {same_results(when(immersed_engine, number(LV_NAMED(output.checkpoint_interval), "s", positive,
                                                "wall-clock time between checkpoints")))}}};

constexpr Range of_resistance = above_up_to(0.0, 1e6);
constexpr Range of_compliance = above_up_to(0.0, 1e4);
constexpr Range of_elastance = between(0.0, 100.0);

#define LV_LOOP(place, member, unit, range, help) \
  number(LV_NAMED(circulation.closed_loop.place.member), unit, range, help)
/// Arteries and veins of a part of a closed loop.
#define LV_VESSELS(place, part)                                                            \
  LV_LOOP(place, R_ar, "mmHg s/ml", of_resistance, "resistance of the arteries of " part), \
      LV_LOOP(place, C_ar, "ml/mmHg", of_compliance, "compliance of the arteries"),        \
      LV_LOOP(place, L_ar, "mmHg s^2/ml", of_resistance, "inertance of the arteries"),     \
      LV_LOOP(place, R_ven, "mmHg s/ml", of_resistance, "resistance of the veins"),        \
      LV_LOOP(place, C_ven, "ml/mmHg", of_compliance, "compliance of the veins"),          \
      LV_LOOP(place, L_ven, "mmHg s^2/ml", of_resistance, "inertance of the veins")
/// What is said of times whose default follows the heart rate (circulation::with_times_at).
#define of_the_rate \
  "default: that of 75 beats a minute, of other periods as systole (docs/circulation.md)"
constexpr const char* contraction_time = "duration of contraction; " of_the_rate;
constexpr const char* relaxation_time = "duration of relaxation; " of_the_rate;
/// The elastance of a chamber of a closed loop.
#define LV_CHAMBER(place, name)                                                             \
  LV_LOOP(place, E_A, "mmHg/ml", of_elastance, "active elastance of the " name),            \
      LV_LOOP(place, E_B, "mmHg/ml", above_up_to(0.0, 100.0), "passive elastance"),         \
      LV_LOOP(place, T_C, "s", above_up_to(0.0, 3.0), contraction_time),                    \
      LV_LOOP(place, T_R, "s", above_up_to(0.0, 3.0), relaxation_time),                     \
      LV_LOOP(place, t_C, "s", between(0.0, 3.0), "when contraction begins; " of_the_rate), \
      LV_LOOP(place, V_0, "ml", between(0.0, 1000.0), "volume without pressure")

constexpr Group of_circulation[]{
    {joined,
     {&of_beats},
     {choice(LV_NAMED(circulation.kind), "none windkessel closed_loop",
             "three elements with a venous source, or the closed loop of Regazzoni et al. (J. "
             "Comput. Phys. 457:111083, 2022); run by itself, with an elastance for the left "
             "ventricle, and with protocol.kind = \"cycle\" joined to the wall")}},
    {joined,
     {&circuit},
     {number(LV_NAMED(circulation.period), "s", between(0.2, 3.0), "length of a beat, RR")}},
    {Stages(Stage::circulation),
     {&circuit},
     {number(LV_NAMED(circulation.step), "s", above_up_to(0.0, 0.02), "of time"),
      number(LV_NAMED(circulation.beats), "", between(1, 10000), "beats at most"),
      number(LV_NAMED(circulation.tolerance), "", of_limit_cycle,
             "beats end when the last has changed no state by more than this part of itself, "
             "and those to come would add at most ten times as much; 0: never")}},
    {joined,
     {&circuit},
     {choice(LV_NAMED(circulation.valves.law), "quadratic arctangent",
             "a parabola between closed and open, which is monotone and smooth, or the "
             "published closed loop's arctangent of the logarithm of the resistance"),
      number(LV_NAMED(circulation.valves.closed_resistance), "mmHg s/ml", of_resistance,
             "of a closed valve")}},
    {joined,
     {&circuit, &quadratic_valves},
     {number(LV_NAMED(circulation.valves.smoothing), "mmHg", above_up_to(0.0, 10.0),
             "range of the pressure across a valve in which it opens")}},
    {Stages(Stage::circulation),
     {&circuit},
     {number(LV_NAMED(circulation.left_ventricle.E_A), "mmHg/ml", of_elastance,
             "active elastance of the left ventricle, p = (E_B + E_A e(t)) (V - V_0)"),
      number(LV_NAMED(circulation.left_ventricle.E_B), "mmHg/ml", above_up_to(0.0, 100.0),
             "passive elastance"),
      number(LV_NAMED(circulation.left_ventricle.T_C), "s", above_up_to(0.0, 3.0),
             contraction_time),
      number(LV_NAMED(circulation.left_ventricle.T_R), "s", above_up_to(0.0, 3.0), relaxation_time),
      number(LV_NAMED(circulation.left_ventricle.V_0), "ml", between(0.0, 1000.0),
             "volume without pressure"),
      number(LV_NAMED(circulation.start.V_lv), "ml", between(0.0, 2000.0),
             "left ventricular volume; a wall's is that of its filling")}},
    {joined,
     {&circuit},
     {number(LV_NAMED(circulation.start.p_ar_sys), "mmHg", between(0.0, 500.0),
             "pressure of the arterial compliance")}},
    {joined,
     {&onset_counts},
     {number(LV_NAMED(circulation.left_ventricle.t_C), "s", between(0.0, 3.0),
             "when contraction begins; of a wall in a closed loop, when calcium rises")}},
    {joined,
     {&windkessel},
     {number(LV_NAMED(circulation.windkessel.R_mv), "mmHg s/ml", of_resistance,
             "open mitral valve"),
      number(LV_NAMED(circulation.windkessel.R_ao), "mmHg s/ml", of_resistance,
             "open aortic valve"),
      number(LV_NAMED(circulation.windkessel.R_c), "mmHg s/ml", of_resistance,
             "characteristic resistance of the aorta"),
      number(LV_NAMED(circulation.windkessel.R_p), "mmHg s/ml", of_resistance,
             "peripheral resistance"),
      number(LV_NAMED(circulation.windkessel.C), "ml/mmHg", of_compliance, "arterial compliance"),
      number(LV_NAMED(circulation.windkessel.p_ven), "mmHg", between(0.0, 100.0),
             "pressure of the venous source")}},
    {joined,
     {&closed_loop},
     {number(LV_NAMED(circulation.closed_loop.blood), "ml", between(0.0, 20000.0),
             "blood in chambers and in stressed vessels, shared out as circulation.start has "
             "it; 0: what circulation.start holds, and a wall's filling"),
      number(LV_NAMED(circulation.closed_loop.valve_resistance), "mmHg s/ml", of_resistance,
             "of an open valve"),
      LV_VESSELS(systemic, "the body"), LV_VESSELS(pulmonary, "the lungs"),
      LV_CHAMBER(left_atrium, "left atrium"), LV_CHAMBER(right_atrium, "right atrium"),
      LV_CHAMBER(right_ventricle, "right ventricle"),
      number(LV_NAMED(circulation.start.V_la), "ml", between(0.0, 2000.0), "left atrial volume"),
      number(LV_NAMED(circulation.start.V_ra), "ml", between(0.0, 2000.0), "right atrial volume"),
      number(LV_NAMED(circulation.start.V_rv), "ml", between(0.0, 2000.0),
             "right ventricular volume"),
      number(LV_NAMED(circulation.start.p_ven_sys), "mmHg", between(0.0, 500.0),
             "pressure of the veins of the body"),
      number(LV_NAMED(circulation.start.p_ar_pul), "mmHg", between(0.0, 500.0),
             "pressure of the arteries of the lungs"),
      number(LV_NAMED(circulation.start.p_ven_pul), "mmHg", between(0.0, 500.0),
             "pressure of the veins of the lungs"),
      number(LV_NAMED(circulation.start.Q_ar_sys), "ml/s", any,
             "flow through the arteries of the body"),
      number(LV_NAMED(circulation.start.Q_ven_sys), "ml/s", any, "flow through its veins"),
      number(LV_NAMED(circulation.start.Q_ar_pul), "ml/s", any,
             "flow through the arteries of the lungs"),
      number(LV_NAMED(circulation.start.Q_ven_pul), "ml/s", any, "flow through their veins")}}};

#undef LV_CHAMBER
#undef LV_VESSELS
#undef LV_LOOP

std::vector<Parameter> rows_of_all() {
  std::vector<Parameter> rows;
  for (const std::span<const Group> groups :
       {std::span<const Group>(of_anatomy), std::span<const Group>(of_mesh),
        std::span<const Group>(of_infarct), std::span<const Group>(of_muscle),
        std::span<const Group>(of_blood_and_base), std::span<const Group>(of_measurements),
        std::span<const Group>(of_circulation), std::span<const Group>(of_study),
        std::span<const Group>(of_protocol)})
    for (const Group& group : groups)
      for (const Parameter& row : group.rows)
        rows.push_back(in_group(group, row));
  return rows;
}

/// The conditions of a parameter that do not hold in a stage.
std::vector<const Condition*> missing(const Parameter& p, const Case& c, Stage stage) {
  std::vector<const Condition*> all;
  for (const Condition* condition : p.conditions)
    if (condition != nullptr && !condition->holds(c, stage))
      all.push_back(condition);
  return all;
}

}  // namespace

bool has_stage(const Case& c, Stage stage) {
  switch (stage) {
    case Stage::circulation:
      return c.circulation.asked();
    case Stage::strain:
      return c.strain.asked();
    case Stage::calibrate:
      return c.calibration.asked();
    case Stage::unload:
      return is_loaded(c);
    default:
      return true;
  }
}

bool counts(const Parameter& p, const Case& c, Stage stage) {
  return p.read_by.contains(stage) && has_stage(c, stage) && missing(p, c, stage).empty();
}

std::string counts_only(const Parameter& p, const Case& c) {
  std::optional<std::vector<const Condition*>> least;  // of the stages that the case has, if any
  bool present = false;
  for (const Stage stage : all_stages) {
    const bool has = has_stage(c, stage);
    if (!p.read_by.contains(stage) || (present && !has))
      continue;
    const std::vector<const Condition*> now = missing(p, c, stage);
    if (now.empty() && has)
      return "";
    if (!least || has > present || now.size() < least->size())
      least = now;
    present = has;
  }
  std::vector<std::string> words;
  for (const Condition* condition : least.value_or(std::vector<const Condition*>{}))
    words.emplace_back(condition->words);
  return fmt::format("{}", fmt::join(words, " and "));
}

const Parameter* find_parameter(const std::string& name) {
  const auto& all = parameters();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Parameter& p) { return p.name == name; });
  return found == all.end() ? nullptr : &*found;
}

bool is_set(const Case& c, const std::string& parameter, Stage asking) {
  const Parameter& p = *find_parameter(parameter);
  LV_CHECK(asking == Stage::results || p.remark_whether_set.contains(asking) ||
           (p.whether_set_counts && p.read_by.contains(asking)));
  return c.origin.contains(parameter);
}

const std::vector<Parameter>& parameters() {
  static const std::vector<Parameter> all = rows_of_all();
  return all;
}

// NOLINTNEXTLINE(readability-function-size): a table
const std::vector<Section>& sections() {
  static const std::vector<Section> all{
      {"", "The case"},
      {"anatomy",
       "Shape of the wall at early diastole, taken as free of stress unless [unloaded] says "
       "otherwise"},
      {"anatomy.ellipsoid",
       "Truncated ellipsoids (source = \"ellipsoid\"); the default is the idealised healthy "
       "ventricle"},
      {"anatomy.contours",
       "Contours drawn on images (source = \"contours\"), and how B-spline surfaces are fitted to "
       "them: the latter holds for every wall that is drawn"},
      {"anatomy.labels",
       "A label map (source = \"labels\"): its borders on the slices become contours"},
      {"anatomy.sunnybrook",
       "Contours in pixels with their DICOM images (source = \"sunnybrook\")"},
      {"anatomy.guide_points", "A list of points on the borders (source = \"guide_points\")"},
      {"anatomy.contour_file", "Contours of another program (source = \"contour_file\")"},
      {"anatomy.surfaces",
       "Surfaces of endocardium and epicardium made elsewhere (source = \"surfaces\")"},
      {"segment",
       "Borders drawn by the program in a short-axis cine (anatomy.source = \"cine\", and "
       "`ventricle segment`)"},
      {"anatomy.mesh", "A mesh made elsewhere (source = \"mesh\")"},
      {"mesh", "Hexahedral mesh of the wall (every source but \"mesh\")"},
      {"fibres", "Rule-based fibre and sheet directions"},
      {"regions",
       "Division of the wall for tables: the paper's seven slices and the AHA's 17 segments"},
      {"quasi_static", "The quasi-static engine (engine = \"quasi_static\", and calibration)"},
      {"passive", "Passive muscle"},
      {"passive.holzapfel_ogden",
       "Holzapfel-Ogden law; the defaults are the paper's healthy subject"},
      {"passive.guccione", "Guccione law (law = \"guccione\")"},
      {"passive.neo_hookean", "Neo-Hookean law (law = \"neo_hookean\")"},
      {"volumetric", "Incompressibility"},
      {"infarct", "The infarct: its extent M and what it does to the muscle"},
      {"infarct.described",
       "An idealised infarct (source = \"described\"): a sector of the wall and the apex all "
       "round"},
      {"infarct.elements", "Elements of an imported mesh (source = \"elements\")"},
      {"infarct.surface", "What a closed surface encloses (source = \"surface\")"},
      {"infarct.labels", "Voxels of a segmented image (source = \"labels\")"},
      {"infarct.strain", "Segments that hardly shorten (source = \"strain\")"},
      {"infarct.lge",
       "A late-enhancement image, with a threshold or with scar drawn on it (source = \"lge\")"},
      {"active",
       "Active tension; all but law and tension belong to the law of Niederer, Hunter and Smith"},
      {"active.land2017",
       "The law of Land et al. (J. Mol. Cell. Cardiol. 106:68, 2017) with its whole-organ "
       "constants (law = \"land2017\")"},
      {"calcium", "Intracellular calcium, the same everywhere"},
      {"muscle", "Density, viscosity and segments of the muscle"},
      {"blood", "Blood and muscle share density and viscosity"},
      {"box", "The box of blood around the ventricle and its grid"},
      {"coupling", "How the wall's finite elements meet the grid"},
      {"base", "How the basal plane is held"},
      {"pericardium", "What holds the epicardium: springs and dashpots to where it was undeformed"},
      {"septum", "What the right ventricle does to the septum"},
      {"unloaded", "The shape without load, when the one that was seen is a loaded one"},
      {"calibrate",
       "Fitting of passive and active parameters to measured volumes, strains and shape, and of "
       "heartbeats to volumes and a cuff's pressures, with the quasi-static engine"},
      {"strain", "Strain measured from cine images, and what the model's is compared with"},
      {"circulation",
       "The circulation, by itself (`ventricle circulation`) or joined to the wall (protocol.kind "
       "= \"cycle\")"},
      {"circulation.valves", "What all valves have in common"},
      {"circulation.left_ventricle",
       "The elastance that stands for the left ventricle; contraction follows half a cosine, and "
       "so does relaxation"},
      {"circulation.start",
       "Where the circulation starts; a closed loop keeps the blood that it starts with"},
      {"circulation.windkessel", "Three elements and a venous source (kind = \"windkessel\")"},
      {"circulation.closed_loop", "Four chambers, body and lungs (kind = \"closed_loop\")"},
      {"circulation.closed_loop.systemic", "Arteries and veins of the body"},
      {"circulation.closed_loop.pulmonary", "Arteries and veins of the lungs"},
      {"circulation.closed_loop.left_atrium", "An elastance"},
      {"circulation.closed_loop.right_atrium", "An elastance"},
      {"circulation.closed_loop.right_ventricle", "An elastance"},
      {"study",
       "A family of heartbeats for `ventricle study`: lists of factors, 1 being the case itself. "
       "Every contractility and heart rate meets every preload and afterload"},
      {"protocol", "Pressures, timings and the ends of the phases"},
      {"cycle", "Heartbeats of the wall joined to the circulation (protocol.kind = \"cycle\")"},
      {"activation", "When the calcium of a heartbeat begins at each point of the wall"},
      {"time", "Time steps"},
      {"output", "What is kept, and how often"}};
  return all;
}

}  // namespace lv::case_file
