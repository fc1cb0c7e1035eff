#include "lv/pipeline/confirmation.hpp"

#include "lv/base/json_file.hpp"
#include "lv/base/table.hpp"
#include "lv/base/units.hpp"
#include "lv/pipeline/fit_archive.hpp"

namespace lv::pipeline {
namespace {

using Json = nlohmann::ordered_json;
using heartbeat::Archive;
using units::ml;

/// A row of a beat's parameters, whether it is within the tolerance and how many volumes it has.
constexpr std::size_t beat_width = parameter_count + 2;

Json json_of(const ConfirmedBeat& beat) {
  Json volumes = Json::array();
  for (const ConfirmedVolume& v : beat.volumes)
    volumes.push_back({{"name", v.name},
                       {"measured_ml", v.measured / ml},
                       {"quasi_static_ml", v.quasi_static / ml},
                       {"beat_ml", v.beat / ml},
                       {"off", v.off()}});
  return {{"parameters", calibrate::json_of(beat.parameters)},
          {"volumes", volumes},
          {"within_tolerance", beat.is_within}};
}

std::string json_of(const Confirmation& record) {
  Json json{{"parameters", calibrate::json_of(record.parameters)}, {"beats", Json::array()}};
  for (const ConfirmedBeat& beat : record.beats)
    json["beats"].push_back(json_of(beat));
  json["tolerance"] = record.tolerance;
  return json.dump(2) + "\n";
}

/// The next volume's, of rows of three numbers.
ConfirmedVolume volume_in(const std::vector<std::string>& names, const std::vector<double>& rows,
                          std::size_t k) {
  return {names[k], rows[3 * k], rows[3 * k + 1], rows[3 * k + 2]};
}

}  // namespace

void write_confirmation(const Confirmation& record, const std::filesystem::path& file) {
  Archive archive;
  store(record.parameters, archive);
  archive.set("tolerance", {record.tolerance});
  std::vector<double> beats;
  std::vector<double> volumes;
  std::vector<std::string> names;
  for (const ConfirmedBeat& beat : record.beats) {
    const auto parameters = numbers(beat.parameters);
    beats.insert(beats.end(), parameters.begin(), parameters.end());
    beats.insert(beats.end(),
                 {beat.is_within ? 1.0 : 0.0, static_cast<double>(beat.volumes.size())});
    for (const ConfirmedVolume& v : beat.volumes) {
      names.push_back(v.name);
      volumes.insert(volumes.end(), {v.measured, v.quasi_static, v.beat});
    }
  }
  archive.set("beats", std::move(beats));
  archive.set("volumes", std::move(volumes));
  archive.set_words("volumes.names", names);
  write_file(for_readers(file), json_of(record));
  archive.write(file);
}

Confirmation read_confirmation(const std::filesystem::path& file) {
  const Archive archive = Archive::read(file);
  Confirmation record{load_parameters(archive), archive.number("tolerance"), {}};
  const auto names = archive.get_words("volumes.names");
  const auto& volumes = archive.get_rows("volumes", 3, names.size());
  const auto& beats = archive.get_rows("beats", beat_width);
  std::size_t next = 0;
  for (std::size_t b = 0; b < beats.size(); b += beat_width) {
    const double* row = &beats[b];
    record.beats.push_back(
        {parameters_of(std::span<const double, parameter_count>(row, parameter_count)),
         {},
         archive.whole_number(row[parameter_count], {0.0, 1.0}) == 1});
    const int count = archive.whole_number(row[parameter_count + 1],
                                           {0.0, static_cast<double>(names.size() - next)});
    for (int n = 0; n < count; ++n)
      record.beats.back().volumes.push_back(volume_in(names, volumes, next++));
  }
  if (record.beats.empty())
    archive.refuse("it holds no beat");
  return record;
}

}  // namespace lv::pipeline
