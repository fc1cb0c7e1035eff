#!/usr/bin/env python3
"""A study whose DICOM files and folder say who the patient is: nothing of that stands in what the program prints, and neither
that nor the folder in any file that it writes (page, tables, logs, pictures). Usage: privacy.py VENTRICLE. Skipped (77)
without pydicom."""
import base64
import pathlib
import re
import subprocess
import sys
import tempfile
import zlib

try:
    import pydicom
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

program = pathlib.Path(sys.argv[1]).resolve()
failures = []
patient = {
    "PatientName": "Quixworth^Zebedee", "PatientID": "PID7391QX", "PatientBirthDate": "19470213", "PatientAddress": "Gryphonlane 7731",
    "OtherPatientIDs": "OPID5528QX", "AccessionNumber": "ACC8842QX", "StudyID": "STU4417QX", "StudyDate": "20190423",
    "StudyInstanceUID": "1.2.826.77315531", "ReferringPhysicianName": "Wolpertinger^Ada", "PerformingPhysicianName": "Nachtkrabb^Otto",
    "OperatorsName": "Elwetritsch^Eva", "InstitutionName": "Hospital Xanadu", "StudyDescription": "Heart of Quixworth",
    "PatientComments": "comment 6620QX", "DeviceSerialNumber": "DEV3391QX"}
telling = ["Quixworth", "Zebedee", "PID7391QX", "19470213", "1947-02-13", "13.02.1947", "Gryphonlane", "OPID5528QX", "ACC8842QX", "STU4417QX",
           "20190423", "77315531", "Wolpertinger", "Nachtkrabb", "Elwetritsch", "Xanadu", "6620QX", "DEV3391QX"]
place = "Zzyzxfolder_Marmaduke"  # of the folder above the study


def check(claim, holds, detail=""):
    print(f"{'pass' if holds else 'FAIL'}  {claim}{f': {detail}' if detail and not holds else ''}", flush=True)
    if not holds:
        failures.append(claim)


def run(folder, *command):
    done = subprocess.run([program, *command], cwd=folder, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


def texts_of(file):
    """The bytes of a file, and what is packed in it: base64 and deflated pieces, as pages and VTK files have."""
    content = file.read_bytes()
    yield content
    yield content.replace(b"\0", b"")  # UTF-16
    for piece in re.findall(rb"[A-Za-z0-9+/]{40,}={0,2}", content):
        raw = base64.b64decode(piece + b"=" * (-len(piece) % 4))
        yield raw
        try:
            yield zlib.decompressobj(47).decompress(raw)
        except zlib.error:
            pass
    for start in re.finditer(rb"\x78[\x01\x5e\x9c\xda]", content):
        try:
            yield zlib.decompressobj().decompress(content[start.start():])
        except zlib.error:
            pass


def found_in(content, words):
    lower = content.lower()
    return [word for word in words if word.lower().encode() in lower]


def check_files(claim, folder, words):
    files = [file for file in folder.rglob("*") if file.is_file()]
    check(f"{claim}: there are files", len(files) > 5, str(len(files)))
    leaks = {str(file.relative_to(folder)): sorted(words_found) for file in files
             if (words_found := {w for content in texts_of(file) for w in found_in(content, words)})}
    check(f"{claim}: none of {len(files)} files names the patient", not leaks, str(leaks))


def made_study(above):
    study = above / place / "Quixworth_Zebedee_19470213"
    study.parent.mkdir()
    subprocess.run([program, "phantom", study, "--phases", "5", "--field-of-view", "150", "--pixel", "2", "--thickness", "12",
                    "--nifti", "false"], check=True, capture_output=True)
    for file in (study / "dicom").iterdir():
        image = pydicom.dcmread(file)
        for name, value in patient.items():
            setattr(image, name, value)
        image.save_as(file)
    check("the test finds a name that is there", found_in((study / "dicom").glob("*").__next__().read_bytes(), telling) != [])
    case = (study / "case.toml").read_text()
    (study / "mine.toml").write_text('engine = "quasi_static"\n' + case + '\n[quasi_static]\nedge_length = "16 mm"\n')
    return study


with tempfile.TemporaryDirectory() as temporary:
    above = pathlib.Path(temporary)
    study = made_study(above)
    for command in (("images", "dicom"), ("images", "dicom/" + min(f.name for f in (study / "dicom").iterdir())), ("validate", "mine.toml")):
        code, said = run(study, *command)
        check(f"{command[0]} of the study: exit code 0", code == 0, said[-600:])
        check(f"{command[0]} does not name the patient", not found_in(said.encode(), [*telling, place]), said)
    # by whole names, which log and tables must shorten, to the end; beside the case, where nothing printed may tell, to the mesh
    code, said = run(study, "run", study / "mine.toml", "--work", above / "work", "--ranks", "1")
    check("run by whole names: exit code 0", code == 0, said[-600:])
    check_files("run by whole names", above / "work", [*telling, place])
    code, said = run(study, "run", "mine.toml", "--work", "result", "--ranks", "1", "--until", "mesh")
    check("run beside the case: exit code 0", code == 0, said[-600:])
    check_files("run beside the case", study / "result", [*telling, place])
    check("run does not name the patient", not found_in(said.encode(), [*telling, place]), said)
print(f"{len(failures)} failed")
sys.exit(1 if failures else 0)
