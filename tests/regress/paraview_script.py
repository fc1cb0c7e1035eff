#!/usr/bin/env python3
"""Where paraview.py puts walls, seen by its cameras: a stand-in for ParaView records what the script sets.
Usage: paraview_script.py FILE; prints views as JSON: {view: {letter: [right, up, towards the viewer]}}"""
import json
import runpy
import sys
import types

import numpy


class Thing:
    """Takes every attribute and every call."""

    def __init__(self, *_, **attributes):
        # ParaView makes an object of ClipType="Plane" and SliceType="Plane"
        self.__dict__.update({name: Thing() if name.endswith("Type") else value for name, value in attributes.items()})

    def __getattr__(self, name):
        self.__dict__[name] = Thing()
        return self.__dict__[name]

    def __call__(self, *_, **attributes):
        return Thing(**attributes)


shown = []


def show(source, *_):
    shown.append((source, Thing()))
    return shown[-1][1]


view = Thing()
clips = []


def clip(**attributes):
    clips.append(Thing(**attributes))
    return clips[-1]


simple = types.ModuleType("paraview.simple")
for name in ("ColorBy", "GetColorTransferFunction", "GetScalarBar", "PVDReader", "Slice", "Hide", "Text", "Line",
             "GetAnimationScene", "AnnotateTimeFilter", "FindSource", "Render"):
    setattr(simple, name, (lambda *_, **attributes: Thing(**attributes)))
simple.GetActiveViewOrCreate, simple.Show, simple.Clip = lambda _: view, show, clip
sys.modules["paraview"], sys.modules["paraview.simple"] = types.ModuleType("paraview"), simple
script = runpy.run_path(sys.argv[1])


def seen(place):
    """Right, up and towards the viewer, of a place against the point that the camera looks at."""
    away = numpy.subtract(view.CameraFocalPoint, view.CameraPosition)
    right = numpy.cross(away, view.CameraViewUp)
    up = numpy.cross(right, away)
    return [float(numpy.dot(numpy.subtract(place, view.CameraFocalPoint), axis) / numpy.linalg.norm(axis))
            for axis in (right, up, -away)]


letters = {source.Text: display.BillboardPosition for source, display in shown
           if isinstance(source.__dict__.get("Text"), str) and len(source.Text.strip("*")) == 1}
views = {}
for name in script["views"]:
    script["look"](name)
    views[name] = {letter: seen(place) for letter, place in letters.items()}
script["look"]("four-chamber")
half = clips[0]
views["kept half"] = seen(numpy.subtract(view.CameraFocalPoint, half.ClipType.Normal) if half.Invert
                          else numpy.add(view.CameraFocalPoint, half.ClipType.Normal))
print(json.dumps(views))
