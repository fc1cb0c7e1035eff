#!/usr/bin/env python3
"""Files of other programs, written here by writers that are not this program's (pydicom, SciPy, NiBabel, meshio, gzip): an
oblique ventricle of known shape, on slices with gaps, at two times, must come out with its volumes and in its place.
Usage: formats.py VENTRICLE. Skipped (77) where a writer is missing."""
import gzip
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import zipfile
import zlib

try:
    import meshio
    import nibabel
    import numpy as np
    import pydicom
    import scipy.io
    from pydicom.dataset import Dataset, FileDataset, FileMetaDataset
    from pydicom.sequence import Sequence
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

program = pathlib.Path(sys.argv[1]).resolve()
failures = []

# The ventricle: ellipsoids x^2/r^2 + z^2/l^2 = 1 up to z = 20 mm; at the second time narrower.
ENDO, EPI, TOP, STEP = (25.0, 60.0), (35.0, 70.0), 20.0, 8.0
HEIGHTS = [TOP - STEP * (s + 0.5) for s in range(9)]
NARROW = 0.8
CENTRE = np.array([25.0, -40.0, 60.0])
angle, axis = 1.1, np.array([0.4, 0.5, -0.6]) / np.linalg.norm([0.4, 0.5, -0.6])
K = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
AXES = np.eye(3) + math.sin(angle) * K + (1 - math.cos(angle)) * K @ K  # columns; z towards the base


def volume(r, l):
    return math.pi * r * r * (2 * l / 3 + TOP - TOP**3 / (3 * l * l)) * 1e-3


def loop(side, z, time=0, count=80):
    """Points of one border, LPS."""
    r, l = side
    a = 2 * math.pi * np.arange(count) / count
    rho = r * (NARROW if time else 1.0) * math.sqrt(1 - (z / l) ** 2)
    return CENTRE + (AXES @ np.array([rho * np.cos(a), rho * np.sin(a), np.full(count, z)])).T


def check(claim, holds, detail=""):
    print(f"{'pass' if holds else 'FAIL'}  {claim}{f': {detail}' if detail else ''}", flush=True)
    if not holds:
        failures.append(claim)


def wall_of(folder, name, lines):
    """The volumes and the frame of the case; None, with what was said, where it is refused."""
    case = folder / f"{name}.toml"
    case.write_text(lines)
    done = subprocess.run([program, "run", case, "--until", "anatomy", "--work", folder / f"{name}.work", "--ranks", "1"],
                          capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return None, done.stderr
    result = folder / f"{name}.work" / "01_anatomy"
    return (json.loads((result / "quality.json").read_text()), json.loads((result / "frame.json").read_text())), done.stdout


def check_wall(folder, name, lines, time=0, most=0.03):
    found, said = wall_of(folder, name, lines)
    if found is None:
        check(name, False, said[-800:])
        return
    quality, frame = found
    narrow = NARROW**2 if time else 1.0
    cavity, whole = volume(*ENDO) * narrow, volume(*EPI) * narrow
    at, up = np.array(frame["origin_in_image_space_mm"]), np.array(frame["z_axis_in_image_space"])
    off = (quality["cavity_ml"]["fitted"] / cavity - 1, quality["wall_ml"]["fitted"] / (whole - cavity) - 1,
           np.linalg.norm(at - CENTRE - TOP * AXES[:, 2]), math.degrees(math.acos(min(1.0, float(up @ AXES[:, 2])))))
    check(name, abs(off[0]) < most and abs(off[1]) < 1.5 * most and off[2] < 1.5 and off[3] < 1.5,
          f"cavity {off[0]:+.2%}, wall {off[1]:+.2%}, base {off[2]:.2f} mm and {off[3]:.2f} degrees off")


def check_refused(folder, name, lines, *words):
    found, said = wall_of(folder, name, lines)
    check(f"{name} is refused", found is None and all(w in said for w in words), said[-600:] if found is None else "it was read")


# Voxels: i along the first axis, j the second, k from the apex to the base; 1.25 x 1.5 x 8 mm.
SIZE, SPACING = (72, 64, 14), np.array([1.25, 1.5, STEP])
ORIGIN = CENTRE + AXES @ np.array([-45.0, -48.0, HEIGHTS[0] - STEP * (SIZE[2] - 3)])


def masks(time=0):
    """Blood and the whole heart."""
    i, j, k = np.meshgrid(*(np.arange(n) for n in SIZE), indexing="ij")
    x, y, z = -45.0 + 1.25 * i, -48.0 + 1.5 * j, HEIGHTS[0] - STEP * (SIZE[2] - 3) + STEP * k
    rho2 = (x * x + y * y) / (NARROW**2 if time else 1.0)
    inside = lambda r, l: (rho2 / r**2 + (z / l) ** 2 < 1) & (z < TOP)
    return inside(*ENDO), inside(*EPI)


def labels(time=0):
    blood, whole = masks(time)
    return np.where(blood, 1, np.where(whole, 2, 0)).astype(np.uint8)


def labelled(file, cavity="[1]", muscle="[2]", more=""):
    return f'[anatomy]\nsource = "labels"\n[anatomy.labels]\nfile = "{file}"\ncavity = {cavity}\nmuscle = {muscle}\n{more}'


def vector(v):
    return "(" + ",".join(f"{x:.12g}" for x in v) + ")"


def write_nrrd(file, values, fields, ras=False, first="", last=""):
    sign = np.array([-1, -1, 1]) if ras else np.ones(3)
    steps = " ".join(vector(sign * AXES[:, d] * SPACING[d]) for d in range(3))
    head = (f"NRRD0005\ntype: uint8\ndimension: {values.ndim}\nspace: {'right-anterior-superior' if ras else 'left-posterior-superior'}\n"
            f"sizes: {' '.join(map(str, values.shape))}\nspace directions: {first}{steps}{last}\nencoding: gzip\n"
            f"space origin: {vector(sign * ORIGIN)}\n{fields}\n")
    file.write_bytes(head.encode() + gzip.compress(values.tobytes(order="F")))


def write_meta_image(file, values):
    data = zlib.compress(values.tobytes(order="F"))
    matrix = " ".join(f"{x:.12g}" for d in range(3) for x in AXES[:, d])
    file.write_bytes((f"ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = True\n"
                      f"CompressedDataSize = {len(data)}\nTransformMatrix = {matrix}\nOffset = {' '.join(map(str, ORIGIN))}\n"
                      f"AnatomicalOrientation = RAI\nElementSpacing = {' '.join(map(str, SPACING))}\n"
                      f"DimSize = {' '.join(map(str, values.shape))}\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n").encode() + data)


def check_voxels(folder):
    affine = np.eye(4)
    affine[:3, :3] = np.diag([-1, -1, 1]) @ AXES @ np.diag(SPACING)
    affine[:3, 3] = np.diag([-1, -1, 1]) @ ORIGIN
    nibabel.save(nibabel.Nifti2Image(labels(), affine), folder / "map.nii.gz")
    check_wall(folder, "NIfTI-2 by NiBabel", labelled("map.nii.gz"))
    write_meta_image(folder / "map.mha", labels())
    check_wall(folder, "MetaImage, packed", labelled("map.mha"))
    for ras in (False, True):
        write_nrrd(folder / f"map{ras}.nrrd", labels(), "kinds: domain domain domain\n", ras)
        check_wall(folder, f"NRRD in {'RAS' if ras else 'LPS'}", labelled(f"map{ras}.nrrd"))
    both = np.stack([labels(), labels(1)], axis=3)
    write_nrrd(folder / "times.nrrd", both, 'kinds: domain domain domain time\nspacings: nan nan nan 0.04\nunits: "" "" "" "s"\n',
               last=" none")
    check_wall(folder, "NRRD over time", labelled("times.nrrd", more="frame = 2\n"), time=1)
    check_refused(folder, "NRRD over time without a frame", labelled("times.nrrd"), "anatomy.labels.frame is not set", "2 frames")
    listed = subprocess.run([program, "images", folder / "times.nrrd"], capture_output=True, text=True, check=False).stdout
    check("images tells its times", "2 frames 40 ms apart" in listed, listed[:300])
    blood, whole = masks()
    names = "".join(f"Segment{n}_ID:=S{n}\nSegment{n}_Name:={name}\nSegment{n}_LabelValue:=1\nSegment{n}_Layer:={n}\n"
                    for n, name in enumerate(("Epicardial volume", "LV blood")))
    write_nrrd(folder / "layers.seg.nrrd", np.stack([whole, blood]).astype(np.uint8), "kinds: list domain domain domain\n" + names,
               first="none ")
    listed = subprocess.run([program, "images", folder / "layers.seg.nrrd"], capture_output=True, text=True, check=False).stdout
    check("images names segments and what they share", '3 "Epicardial volume + LV blood"' in listed, listed[:600])
    check_wall(folder, "overlapping segments", labelled("layers.seg.nrrd", "[3]", "[1]"))


def check_mirrored(folder):
    """A heart that lies as in people, and the same voxels with a header that mirrors them."""
    septal = np.array([-0.57, -0.81, 0.10]) / np.linalg.norm([-0.57, -0.81, 0.10])  # in LPS
    up = np.cross(septal, [0.45, -0.20, 0.87])
    up /= np.linalg.norm(up)
    axes = np.column_stack([septal, np.cross(up, septal), up])
    i, j, _ = np.meshgrid(*(np.arange(n) for n in SIZE), indexing="ij")
    right = np.hypot(-45.0 + 1.25 * i - 45.0, -48.0 + 1.5 * j) < 22.0  # blood of the right ventricle beside the septum
    values = np.where((labels() == 0) & right, 3, labels()).astype(np.uint8)
    for name, signs in (("lies_as_in_people", [-1, -1, 1]), ("mirrored", [1, -1, 1])):
        place = np.eye(4)
        place[:3, :3] = np.diag(signs) @ axes * SPACING
        image = nibabel.Nifti1Image(values, place)
        image.header.set_xyzt_units("mm")
        nibabel.save(image, folder / f"{name}.nii.gz")
        found, said = wall_of(folder, name, labelled(f"{name}.nii.gz", more="right_ventricle = [3]\n"))
        warned = found is not None and "seems mirrored" in json.dumps(found[1]["warnings"])
        check(f"{name}: it is {'' if name == 'mirrored' else 'not '}said that the image seems mirrored",
              found is not None and warned == (name == "mirrored"), said[-400:])


def written(file, dataset, sop_class, uid):
    meta = FileMetaDataset()
    meta.MediaStorageSOPClassUID, meta.MediaStorageSOPInstanceUID = sop_class, uid
    meta.TransferSyntaxUID = pydicom.uid.ExplicitVRLittleEndian
    out = FileDataset(str(file), dataset, file_meta=meta, preamble=b"\0" * 128)
    out.is_little_endian, out.is_implicit_VR = True, False
    out.SOPClassUID, out.SOPInstanceUID = sop_class, uid
    out.save_as(str(file), write_like_original=False)


def data_set(**attributes):
    made = Dataset()
    for name, value in attributes.items():
        setattr(made, name, value)
    return made


def text(values):
    return [f"{x:.8f}" for x in values]


ORIENTATION = text(np.concatenate([AXES[:, 0], AXES[:, 1]]))


def check_segmentation(folder):
    for times in (1, 2):
        frames, groups = [], []
        for t in range(times):
            blood, whole = masks(t)
            for number, mask in ((1, blood), (2, whole & ~blood)):
                for k in reversed(range(SIZE[2])):
                    if not mask[:, :, k].any():
                        continue
                    frames.append(mask[:, :, k].T)
                    content = data_set(DimensionIndexValues=[number, k + 1])
                    if times > 1:
                        content.TemporalPositionIndex = t + 1
                    groups.append(data_set(
                        FrameContentSequence=Sequence([content]),
                        PlanePositionSequence=Sequence([data_set(ImagePositionPatient=text(ORIGIN + STEP * k * AXES[:, 2]))]),
                        SegmentIdentificationSequence=Sequence([data_set(ReferencedSegmentNumber=number)])))
        made = data_set(
            Modality="SEG", Rows=SIZE[1], Columns=SIZE[0], NumberOfFrames=len(frames), SegmentationType="BINARY", SamplesPerPixel=1,
            PhotometricInterpretation="MONOCHROME2", BitsAllocated=1, BitsStored=1, HighBit=0, PixelRepresentation=0,
            SegmentSequence=Sequence([data_set(SegmentNumber=n, SegmentLabel=name) for n, name in ((1, "LV blood"), (2, "LV wall"))]),
            SharedFunctionalGroupsSequence=Sequence([data_set(
                PlaneOrientationSequence=Sequence([data_set(ImageOrientationPatient=ORIENTATION)]),
                PixelMeasuresSequence=Sequence([data_set(PixelSpacing=["1.5", "1.25"], SliceThickness="8")]))]),
            PerFrameFunctionalGroupsSequence=Sequence(groups))
        bits = np.packbits(np.stack(frames).astype(np.uint8).ravel(), bitorder="little").tobytes()
        made.PixelData = bits + b"\0" * (len(bits) % 2)
        made["PixelData"].VR = "OB"
        written(folder / f"seg{times}.dcm", made, "1.2.840.10008.5.1.4.1.1.66.4", "1.2.3.77")
        check_wall(folder, f"DICOM SEG by pydicom, {times} time{'s'[:times - 1]}",
                   labelled(f"seg{times}.dcm", more="frame = 2\n" if times > 1 else ""), time=times - 1)


def write_images(folder):
    """The images of the slices at both times, empty, of 1.25 x 1.5 mm."""
    folder.mkdir()
    for s, z in enumerate(HEIGHTS):
        for t in range(2):
            corner = CENTRE + AXES @ np.array([-45.0, -48.0, z])
            made = data_set(Modality="MR", Rows=SIZE[1], Columns=SIZE[0], SamplesPerPixel=1, PhotometricInterpretation="MONOCHROME2",
                            BitsAllocated=16, BitsStored=16, HighBit=15, PixelRepresentation=0, PixelSpacing=["1.5", "1.25"],
                            ImagePositionPatient=text(corner), ImageOrientationPatient=ORIENTATION, SeriesInstanceUID="1.2.3", SeriesNumber=4,
                            InstanceNumber=2 * s + t + 1, TriggerTime=str(300 * t), SliceThickness="6", SeriesDescription="cine")
            made.PixelData = bytes(2 * SIZE[0] * SIZE[1])
            made["PixelData"].VR = "OW"
            written(folder / f"{s}_{t}", made, "1.2.840.10008.5.1.4.1.1.4", f"1.2.3.{s + 1}.{t + 1}")


def contour_file(file, more=""):
    return f'[anatomy]\nsource = "contour_file"\n[anatomy.contour_file]\nfile = "{file}"\n{more}'


def drawn_borders(z):
    return [(name, side) for name, side in (("endo", ENDO), ("epi", EPI)) if abs(z) < side[1]]


def check_structures(folder):
    def write(file, times, with_images):
        regions, contours = [], []
        for number, (name, side) in enumerate((("LV endo", ENDO), ("LV epi", EPI), ("Thorax", (90.0, 300.0))), 1):
            regions.append(data_set(ROINumber=number, ROIName=name, ReferencedFrameOfReferenceUID="1.2"))
            drawn = []
            for s, z in enumerate(HEIGHTS):
                for t in range(times):
                    if abs(z) >= side[1]:
                        continue
                    points = data_set(ContourGeometricType="CLOSED_PLANAR", NumberOfContourPoints=80,
                                      ContourData=[f"{x:.4f}" for x in loop(side, z, t).ravel()])
                    if with_images:
                        points.ContourImageSequence = Sequence([data_set(ReferencedSOPClassUID="1.2.840.10008.5.1.4.1.1.4",
                                                                         ReferencedSOPInstanceUID=f"1.2.3.{s + 1}.{t + 1}")])
                    drawn.append(points)
            contours.append(data_set(ReferencedROINumber=number, ContourSequence=Sequence(drawn)))
        written(file, data_set(Modality="RTSTRUCT", StructureSetROISequence=Sequence(regions), ROIContourSequence=Sequence(contours)),
                "1.2.840.10008.5.1.4.1.1.481.3", "1.2.3.88")

    names = 'endo = "LV endo"\nepi = "LV epi"\n'
    write(folder / "one.dcm", 1, False)
    check_wall(folder, "RTSTRUCT by pydicom", contour_file("one.dcm", names))
    check_refused(folder, "RTSTRUCT without names", contour_file("one.dcm"), "anatomy.contour_file.endo and anatomy.contour_file.epi",
                  'endo = "LV endo"', '"Thorax"')
    write(folder / "two.dcm", 2, True)
    check_refused(folder, "RTSTRUCT of two times without images", contour_file("two.dcm", names), "twice", "anatomy.contour_file.images")
    check_wall(folder, "RTSTRUCT of two times with images", contour_file("two.dcm", names + 'images = "images"\nphase = 2\n'), time=1)


def check_segment(folder):
    gone = np.full((80, 2, len(HEIGHTS)), np.nan)
    fields = {f"{name}{c}": gone.copy() for name in ("Endo", "Epi") for c in "XY"}
    # X counts rows, Y columns, from 1; slices follow each other against r x c: from the base to the apex
    first = CENTRE + AXES @ np.array([-45.0, -48.0, HEIGHTS[0]])
    for z, height in enumerate(HEIGHTS):
        for name, side in (("Endo", ENDO), ("Epi", EPI)):
            for t in range(2):
                if abs(height) >= side[1]:
                    continue
                local = (loop(side, height, t) - first) @ AXES
                fields[f"{name}X"][:, t, z] = local[:, 1] / 1.5 + 1
                fields[f"{name}Y"][:, t, z] = local[:, 0] / 1.25 + 1
    stack = {**fields, "ImageOrientation": np.concatenate([AXES[:, 0], AXES[:, 1]]), "ImagePosition": first, "ResolutionX": 1.5,
             "ResolutionY": 1.25, "SliceThickness": 6.0, "SliceGap": 2.0, "TimeVector": np.array([0.0, 0.3]), "EDT": 1.0, "EST": 2.0,
             "Rotated": False, "PatientInfo": {"Name": "DOE^JANE"}}
    scipy.io.savemat(folder / "study.mat", {"setstruct": stack, "info": {"Name": "DOE^JANE"}}, do_compression=True)
    check_refused(folder, "Segment without a phase", contour_file("study.mat"), "anatomy.contour_file.phase is not set",
                  "marks time 1 as end-diastole and 2 as end-systole")
    for phase in (1, 2):
        check_wall(folder, f"Segment by SciPy, time {phase}", contour_file("study.mat", f"phase = {phase}\n"), time=phase - 1)
    stack["Rotated"] = True
    scipy.io.savemat(folder / "rotated.mat", {"setstruct": stack})
    check_refused(folder, "a rotated stack of Segment", contour_file("rotated.mat", "phase = 1\n"), "was rotated")
    listed = subprocess.run([program, "images", folder / "study.mat"], capture_output=True, text=True, check=False).stdout
    check("images lists Segment's structures and times", '"Endo": ' in listed and "at 2 times" in listed and "JANE" not in listed, listed[:400])


def check_cvi42(folder):
    factor, images = 4, []
    for s, z in enumerate(HEIGHTS):
        for t in range(2):
            corner = CENTRE + AXES @ np.array([-45.0, -48.0, z])
            drawn = ""
            for name, side in drawn_borders(z):
                local = (loop(side, z, t) - corner) @ AXES
                points = "".join(f"<List:item><Point:x>{round(factor * (x / 1.25 + 0.5))}</Point:x><Point:y>{round(factor * (y / 1.5 + 0.5))}"
                                 "</Point:y></List:item>" for x, y, _ in local)
                drawn += (f'<Hash:item Hash:key="sa{name}cardialContour"><Hash:item Hash:key="Points">{points}</Hash:item>'
                          f'<Hash:item Hash:key="SubpixelResolution">{factor}</Hash:item></Hash:item>')
            images.append(f'<Hash:item Hash:key="1.2.3.{s + 1}.{t + 1}"><Hash:item Hash:key="Contours">{drawn}</Hash:item></Hash:item>')
    space = "http://www.circlecvi.com/cvi42/Workspace/"
    (folder / "study.cvi42wsx").write_text(
        f'<?xml version="1.0"?><Workspace xmlns:Hash="{space}Hash/" xmlns:List="{space}List/" xmlns:Point="{space}Point/">'
        f'<Hash:item Hash:key="StudyMapStates"><List:item><Hash:item Hash:key="ImageStates">{"".join(images)}</Hash:item></List:item>'
        "</Hash:item></Workspace>")
    check_refused(folder, "cvi42 without images", contour_file("study.cvi42wsx"), "anatomy.contour_file.images is not set")
    with zipfile.ZipFile(folder / "packed.cvi42wsx", "w", zipfile.ZIP_DEFLATED) as packed:
        packed.writestr("read me first.txt", "words")
        packed.write(folder / "study.cvi42wsx", "workspaces/study.cvi42wsx")
    check_wall(folder, "cvi42 in a zip archive", contour_file("packed.cvi42wsx", 'images = "images"\nphase = 1\n'), time=0)
    for phase in (1, 2):
        check_wall(folder, f"cvi42, time {phase}", contour_file("study.cvi42wsx", f'images = "images"\nphase = {phase}\n'), time=phase - 1)


def bowl(side, top, lid):
    """Points and triangles of an ellipsoid up to a height."""
    r, l = side
    around, rings = 60, 50
    polar = math.acos(-top / l) * np.arange(1, rings + 1) / rings
    a = 2 * math.pi * np.arange(around) / around
    ring = np.stack([np.outer(r * np.sin(polar), np.cos(a)), np.outer(r * np.sin(polar), np.sin(a)),
                     np.repeat(-l * np.cos(polar)[:, None], around, 1)], axis=2).reshape(-1, 3)
    points = np.vstack([[0, 0, -l], ring, [0, 0, top]])
    at = lambda k, i: 1 + k * around + i % around
    faces = [(0, at(0, i + 1), at(0, i)) for i in range(around)]
    for k in range(rings - 1):
        for i in range(around):
            faces += [(at(k, i), at(k, i + 1), at(k + 1, i)), (at(k, i + 1), at(k + 1, i + 1), at(k + 1, i))]
    if lid:
        faces += [(len(points) - 1, at(rings - 1, i), at(rings - 1, i + 1)) for i in range(around)]
    else:
        points = points[:-1]
    return CENTRE + points @ AXES.T, np.array(faces)


def write_vtp(file, points, faces):
    """meshio writes no VTP."""
    array = lambda kind, name, values, more="": (f'<DataArray type="{kind}" Name="{name}" {more} format="ascii">'
                                                 f'{" ".join(map(str, np.ravel(values)))}</DataArray>')
    file.write_text(f'<VTKFile type="PolyData"><PolyData><Piece NumberOfPoints="{len(points)}" NumberOfPolys="{len(faces)}">'
                    f'<Points>{array("Float64", "Points", points, "NumberOfComponents=" + chr(34) + "3" + chr(34))}</Points><Polys>'
                    f'{array("Int64", "connectivity", faces)}{array("Int64", "offsets", 3 * np.arange(1, len(faces) + 1))}</Polys>'
                    "</Piece></PolyData></VTKFile>")


def surfaces(ending, more):
    return (f'[anatomy]\nsource = "surfaces"\n[anatomy.surfaces]\nendo = "endo{ending}"\nepi = "epi{ending}"\n{more}')


def check_surfaces(folder):
    for ending, unit, lid in ((".stl", 1.0, False), (".ply", 10.0, True), (".obj", 1.0, False), (".vtp", 1000.0, True)):
        for name, side in (("endo", ENDO), ("epi", EPI)):
            points, faces = bowl(side, TOP, lid)
            sign = np.array([-1, -1, 1]) if ending == ".ply" else 1.0
            write = write_vtp if ending == ".vtp" else lambda file, x, f: meshio.write(file, meshio.Mesh(x, [("triangle", f)]))
            write(folder / f"{name}{ending}", sign * points / unit, faces)
        space = "RAS" if ending == ".ply" else "LPS"
        check_wall(folder, f"surfaces {ending}, {'closed by a lid' if lid else 'open'}, {space}, unit {unit:g} mm",
                   surfaces(ending, f'length_unit = "{unit:g} mm"\nspace = "{space}"\n'))
    check_refused(folder, "surfaces without unit and space", surfaces(".stl", ""), "anatomy.surfaces.space and anatomy.surfaces.length_unit")


with tempfile.TemporaryDirectory() as temporary:
    base = pathlib.Path(temporary)
    write_images(base / "images")
    for test in (check_voxels, check_mirrored, check_segmentation, check_structures, check_segment, check_cvi42, check_surfaces):
        test(base)
print(f"{len(failures)} failed")
sys.exit(1 if failures else 0)
