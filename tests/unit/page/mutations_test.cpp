// What a page is made from, damaged: see support/mutations.hpp.
#include "support/mutations.hpp"

#include "lv/drawing/picture_files.hpp"
#include "lv/page/page.hpp"
#include "lv/page/wall_series.hpp"

#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>

namespace {

using namespace lv;
using test::try_damaged;

/// A page of a work folder with one file in one stage.
test::Read page_with(const std::string& stage, const std::string& name) {
  return [=](const std::filesystem::path& file) {
    const auto work = file.parent_path() / "work";
    std::filesystem::create_directories(work / stage);
    std::filesystem::copy_file(file, work / stage / name,
                               std::filesystem::copy_options::overwrite_existing);
    static_cast<void>(page::page({{work, true, {}}}, "1"));
  };
}

}  // namespace

TEST_CASE("damaged series, tables and summaries of a beat are read or refused",
          "[page][mutations]") {
  const auto series = [](const std::filesystem::path& file) {
    test::write_bytes(file.parent_path() / "wall_0.vtu", "");
    static_cast<void>(page::frames_of(file));
  };
  try_damaged("wall.pvd",
              "<VTKFile type=\"Collection\">\n<Collection>\n"
              "<DataSet timestep=\"0.25\" file=\"wall_0.vtu\"/>\n"
              "<DataSet timestep=\"0.5\" file=\"wall_1.vtu\"/>\n</Collection>\n</VTKFile>\n",
              series);
  try_damaged("moments.csv",
              "moment,phase,time_s,by_criterion\nend_diastole,filling,0.6,yes\n"
              "\"end_systole\",contraction,1.2,no\n",
              page_with("03_beat", "moments.csv"));
  try_damaged("summary.json", "{\"end_diastole\": {\"time_s\": 0.6, \"volume_ml\": 120}}\n",
              page_with("04_results", "summary.json"));
  const auto pictures = [](const std::filesystem::path& file) {
    test::write_bytes(file.parent_path() / "a.png", "");
    static_cast<void>(drawing::read_pictures(file.parent_path()));
  };
  try_damaged("pictures.csv",
              "state,slice,phase,file,origin_x_mm,columns,rows,spacing_i_mm,spacing_j_mm\n"
              "end_diastole,\"long axis 1\",3,a.png,-2.5,64,48,1.5,1.5\n",
              pictures);
}
