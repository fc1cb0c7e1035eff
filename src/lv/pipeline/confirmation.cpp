#include "lv/pipeline/confirmation.hpp"

#include "lv/base/json_file.hpp"
#include "lv/base/units.hpp"
#include "lv/calibrate/record.hpp"

namespace lv::pipeline {
namespace {

using Json = nlohmann::ordered_json;
using units::ml;

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

ConfirmedBeat beat_in(const Json& json) {
  ConfirmedBeat beat{
      calibrate::parameters_in(json.at("parameters")), {}, json.at("within_tolerance")};
  for (const Json& v : json.at("volumes"))
    beat.volumes.push_back({v.at("name"), v.at("measured_ml").get<double>() * ml,
                            v.at("quasi_static_ml").get<double>() * ml,
                            v.at("beat_ml").get<double>() * ml});
  return beat;
}

}  // namespace

void write_confirmation(const Confirmation& record, const std::filesystem::path& file) {
  Json json{{"parameters", calibrate::json_of(record.parameters)}, {"beats", Json::array()}};
  for (const ConfirmedBeat& beat : record.beats)
    json["beats"].push_back(json_of(beat));
  json["tolerance"] = record.tolerance;
  write_file(file, json.dump(2) + "\n");
}

Confirmation read_confirmation(const std::filesystem::path& file) {
  return from_json_file(file, [](const Json& json) {
    Confirmation record{calibrate::parameters_in(json.at("parameters")), json.at("tolerance"), {}};
    for (const Json& beat : json.at("beats"))
      record.beats.push_back(beat_in(beat));
    return record;
  });
}

}  // namespace lv::pipeline
