#include "lv/report/page.hpp"

#include <fmt/format.h>

namespace lv::report {

std::string paraview_script(const std::filesystem::path& series) {
  constexpr const char* script =
      R"py(# Opens the wall and the blood of this case in ParaView, coloured, with a time axis:
#   paraview --script=paraview.py
import os
from paraview.simple import *

here = os.path.dirname(os.path.abspath(__file__)) if "__file__" in globals() else os.getcwd()
series = os.path.normpath(os.path.join(here, "{series}"))
view = GetActiveViewOrCreate("RenderView")
view.ViewTime = 0.0


def colour(display, association, array, title, preset, limits):
    ColorBy(display, (association, array))
    table = GetColorTransferFunction(array)
    table.ApplyPreset(preset, True)
    table.RescaleTransferFunction(*limits)
    bar = GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = title, ""
    display.SetScalarBarVisibility(view, True)


wall = PVDReader(registrationName="wall", FileName=os.path.join(series, "wall.pvd"))
half = Clip(registrationName="wall, cut open", Input=wall, ClipType="Plane", Crinkleclip=0)
half.ClipType.Origin = [0.0, 0.0, -40.0]
half.ClipType.Normal = [0.0, 1.0, 0.0]
colour(Show(half, view), "CELLS", "active_tension", "active tension (kPa)", "Viridis (matplotlib)", (0.0, 100.0))

if os.path.exists(os.path.join(series, "blood.pvd")):
    blood = PVDReader(registrationName="blood", FileName=os.path.join(series, "blood.pvd"))
    plane = Slice(registrationName="long-axis plane", Input=blood, SliceType="Plane")
    plane.SliceType.Origin = [0.0, 0.0, -40.0]
    plane.SliceType.Normal = [0.0, 1.0, 0.0]
    colour(Show(plane, view), "CELLS", "velocity", "speed (mm/s)", "Viridis (matplotlib)", (0.0, 1000.0))
    Hide(plane, view)

animation = GetAnimationScene()
animation.UpdateAnimationUsingDataTimeSteps()
AnnotateTimeFilter(registrationName="time", Input=wall, Format="t = {{time:.3f}} s")
Show(FindSource("time"), view)
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [60.0, -330.0, 40.0], [0.0, 0.0, -45.0], [0.0, 0.0, 1.0]
Render()
)py";
  return fmt::format(fmt::runtime(script), fmt::arg("series", series.generic_string()));
}

}  // namespace lv::report
