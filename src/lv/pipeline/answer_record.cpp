#include "lv/pipeline/answer_record.hpp"

#include "lv/base/log.hpp"
#include "lv/base/parallel.hpp"
#include "lv/pipeline/fit_archive.hpp"
#include "lv/pipeline/unloading.hpp"

#include <fmt/format.h>

namespace lv::pipeline {
namespace {

using calibrate::Ventricle;
using heartbeat::Archive;

void store_memory(const Ventricle::Memory& memory, Archive& archive) {
  std::vector<double> loads;
  for (std::size_t n = 0; n < memory.known.size(); ++n) {
    loads.insert(loads.end(), {memory.known[n].loads.pressure, memory.known[n].loads.activation});
    store(memory.known[n].state, equilibrium_name(n), archive);
  }
  archive.set("loads", std::move(loads));
  store(memory.unloaded_with, archive, "unloaded with");
  if (memory.unloaded)
    store(*memory.unloaded, archive);
}

Ventricle::Memory load_memory(const Archive& archive, std::size_t nodes) {
  Ventricle::Memory memory;
  const auto& loads = archive.get_rows("loads", 2);
  for (std::size_t n = 0; 2 * n < loads.size(); ++n)
    memory.known.push_back(
        {{loads[2 * n], loads[2 * n + 1]}, load_state(archive, equilibrium_name(n), nodes)});
  memory.unloaded_with = load_parameters(archive, "unloaded with");
  if (archive.has("unloaded.nodes"))
    memory.unloaded = load_unloaded(archive, nodes);
  return memory;
}

}  // namespace

AnswerRecord::AnswerRecord(Ventricle& ventricle, std::size_t nodes, std::filesystem::path file)
    : ventricle_(ventricle), file_(std::move(file)) {
  if (parallel::root_says(std::filesystem::exists(file_)))
    read(nodes);
}

Outcome<std::vector<double>> AnswerRecord::answer(
    const std::function<Outcome<std::vector<double>>()>& ask) {
  if (given_ < answers_.size()) {
    const Answer& recorded = answers_[given_++];
    if (recorded.empty())
      return Unsolved{"there is no equilibrium, as was found before", ""};
    return recorded;
  }
  ++given_;
  auto found = ask();
  answers_.push_back(found ? *found : Answer{});
  if (found)  // else kept with the next answer: one that ends the fit is found anew
    parallel::on_root([&] { write(); });
  return found;
}

void AnswerRecord::read(std::size_t nodes) {
  const Archive archive = Archive::read(file_);
  const auto& numbers = archive.get_rows("answers", 1);
  auto next = numbers.begin();
  for (const int length : archive.get_whole("lengths", {}, heartbeat::not_negative)) {
    if (length > numbers.end() - next)
      archive.refuse("it has fewer answers than it says");
    answers_.emplace_back(next, next + length);
    next += length;
  }
  ventricle_.restore(load_memory(archive, nodes));
  log::info("the calibration goes on after {} equilibria", answers_.size());
}

void AnswerRecord::write() const {
  Archive archive;
  std::vector<double> lengths;
  std::vector<double> numbers;
  for (const Answer& answer : answers_) {
    lengths.push_back(static_cast<double>(answer.size()));
    numbers.insert(numbers.end(), answer.begin(), answer.end());
  }
  archive.set("lengths", std::move(lengths));
  archive.set("answers", std::move(numbers));
  store_memory(ventricle_.memory(), archive);
  archive.write(file_);
}

}  // namespace lv::pipeline
