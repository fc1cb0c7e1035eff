#include "lv/report/paraview_script.hpp"

#include <fmt/format.h>

namespace lv::report {
namespace {

std::string list(const Vec3& v) {
  return fmt::format("[{:.6f}, {:.6f}, {:.6f}]", v.x(), v.y(), v.z());
}

constexpr const char* script =
    R"py(# Opens the wall and the blood of this case in ParaView, coloured, with a time axis:
#   paraview --script=paraview.py
# In ParaView's Python shell, look("short axis") shows the short axis from the apex; so do "four-chamber", "two-chamber".
import os
from paraview.simple import *

here = os.path.dirname(os.path.abspath(__file__)) if "__file__" in globals() else os.getcwd()
series = os.path.normpath(os.path.join(here, "{series}"))
view = GetActiveViewOrCreate("RenderView")
view.ViewTime = 0.0

# the long axis is z, the base up; a star: the septum is assumed
anterior, septal = {anterior}, {septal}
middle = [0.0, 0.0, -45.0]


def from_middle(*parts):
    return [m + sum(length * direction[i] for length, direction in parts) for i, m in enumerate(middle)]


up = [0.0, 0.0, 1.0]
views = {{"four-chamber": (from_middle((330.0, anterior), (85.0, up)), up),
         "two-chamber": (from_middle((330.0, septal), (85.0, up)), up),
         "short axis": (from_middle((-340.0, up)), anterior)}}


def look(name):
    view.CameraPosition, view.CameraViewUp = views[name]
    view.CameraFocalPoint = middle
    Render()


def write(text, place):
    shown = Show(Text(registrationName=text, Text=text), view, "TextSourceRepresentation")
    shown.TextPropMode, shown.BillboardPosition = "Billboard 3D Text", place
    shown.Bold, shown.FontSize = 1, 20


def colour(display, association, array, title, preset, limits):
    ColorBy(display, (association, array))
    table = GetColorTransferFunction(array)
    table.ApplyPreset(preset, True)
    table.RescaleTransferFunction(*limits)
    bar = GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = title, ""
    display.SetScalarBarVisibility(view, True)


wall = PVDReader(registrationName="wall", FileName=os.path.join(series, "wall.pvd"))
half = Clip(registrationName="wall, cut open", Input=wall, ClipType="Plane", Crinkleclip=0, Invert=1)
half.ClipType.Origin = [0.0, 0.0, -40.0]
half.ClipType.Normal = anterior  # what lies on its side, towards the viewer, is cut away
colour(Show(half, view), "CELLS", "active_tension", "active tension (kPa)", "Viridis (matplotlib)", (0.0, 100.0))

if os.path.exists(os.path.join(series, "blood.pvd")):
    blood = PVDReader(registrationName="blood", FileName=os.path.join(series, "blood.pvd"))
    plane = Slice(registrationName="four-chamber plane", Input=blood, SliceType="Plane")
    plane.SliceType.Origin = [0.0, 0.0, -40.0]
    plane.SliceType.Normal = anterior
    colour(Show(plane, view), "CELLS", "velocity", "speed (mm/s)", "Viridis (matplotlib)", (0.0, 1000.0))
    Hide(plane, view)

for letter, length, direction in (("A", 48.0, anterior), ("S", 48.0, septal), ("I", -48.0, anterior), ("L", -48.0, septal)):
    write(letter + "{star}", from_middle((length, direction), (55.0, up)))
bar = [from_middle((length, septal), (-65.0, up)) for length in (10.0, -10.0)]
Show(Line(registrationName="20 mm, bar", Point1=bar[0], Point2=bar[1]), view).LineWidth = 3.0
write("20 mm", bar[1])

animation = GetAnimationScene()
animation.UpdateAnimationUsingDataTimeSteps()
AnnotateTimeFilter(registrationName="time", Input=wall, Format="t = {{time:.3f}} s")
Show(FindSource("time"), view)
look("four-chamber")
)py";

}  // namespace

std::string paraview_script(const std::filesystem::path& series,
                            const drawing::Orientation& orientation) {
  return fmt::format(fmt::runtime(script), fmt::arg("series", series.generic_string()),
                     fmt::arg("anterior", list(orientation.anterior())),
                     fmt::arg("septal", list(orientation.septal())),
                     fmt::arg("star", orientation.assumes("septum") ? "*" : ""));
}

}  // namespace lv::report
