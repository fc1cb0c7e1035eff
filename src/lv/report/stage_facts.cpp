#include "lv/report/stage_facts.hpp"

#include "lv/heartbeat/archive.hpp"
#include "lv/report/work_folder.hpp"

#include <fmt/format.h>

#include <array>

namespace lv::report {
namespace {

namespace fs = std::filesystem;
using heartbeat::Archive;

/// A flag as the number of an archive, and back.
std::vector<double> flag(bool is_so) {
  return {is_so ? 1.0 : 0.0};
}
bool flag_in(const Archive& archive, const std::string& name) {
  return archive.whole_number(archive.number(name), {0.0, 1.0}) == 1;
}

std::optional<Archive> facts_of(const fs::path& work, const std::string& stage) {
  const fs::path file = file_of(work, stage, facts_name);
  if (file.empty())
    return {};
  return Archive::read(file);
}

}  // namespace

void write_facts(const MeshFacts& facts, const fs::path& folder) {
  Archive archive;
  archive.set("septum_angle", {facts.septum_angle});
  archive.set("order", {static_cast<double>(facts.order)});
  archive.set("is_immersed", flag(facts.is_immersed));
  archive.write(folder / facts_name);
}

void write_facts(const BeatFacts& facts, const fs::path& folder) {
  Archive archive;
  archive.set("has_valves", flag(facts.has_valves));
  archive.write(folder / facts_name);
}

void write_facts(const drawing::Orientation& orientation, const fs::path& folder) {
  std::vector<std::string> parts;
  std::vector<std::string> texts;
  for (const geometry::Assumption& a : orientation.assumed) {
    parts.push_back(a.part);
    texts.push_back(a.text);
  }
  Archive archive;
  archive.set_words("assumed.parts", parts);
  archive.set_words("assumed.texts", texts);
  archive.set("is_unloaded", flag(orientation.is_unloaded));
  archive.write(folder / facts_name);
}

std::optional<MeshFacts> mesh_facts(const fs::path& work) {
  const auto archive = facts_of(work, "mesh");
  if (!archive)
    return {};
  return MeshFacts{archive->number("septum_angle"),
                   archive->whole_number(archive->number("order"), {1.0, 2.0}),
                   flag_in(*archive, "is_immersed")};
}

std::optional<BeatFacts> beat_facts(const fs::path& work) {
  const auto archive = facts_of(work, "beat");
  if (!archive)
    return {};
  return BeatFacts{flag_in(*archive, "has_valves")};
}

drawing::Orientation orientation_of(const fs::path& work) {
  drawing::Orientation o;
  if (const auto mesh = mesh_facts(work))
    o.septum_angle = mesh->septum_angle;
  const auto archive = facts_of(work, "results");
  if (!archive)
    return o;
  const auto parts = archive->get_words("assumed.parts");
  const auto texts = archive->get_words("assumed.texts");
  if (parts.size() != texts.size())
    archive->refuse("it has not as many sentences as assumptions");
  for (std::size_t i = 0; i < parts.size(); ++i)
    o.assumed.push_back({parts[i], texts[i]});
  o.is_unloaded = flag_in(*archive, "is_unloaded");
  return o;
}

std::vector<std::string> missing_facts(const fs::path& work) {
  constexpr std::array<std::array<const char*, 3>, 3> stages{
      {{"mesh", "mesh.bin", "where the septum is"},
       {"beat", "curves.csv", "whether its times are shares of loads"},
       {"results", "summary.json", "what of the anatomy was assumed in figures"}}};
  std::vector<std::string> missing;
  for (const auto& [stage, file, what] : stages)
    if (!file_of(work, stage, file).empty() && file_of(work, stage, facts_name).empty())
      missing.push_back(
          fmt::format("{} has no {}, as those of earlier versions have none: {} is not known until "
                      "ventricle run makes it again.",
                      folder_of(work, stage).filename().string(), facts_name, what));
  return missing;
}

}  // namespace lv::report
