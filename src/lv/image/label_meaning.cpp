#include "lv/image/label_meaning.hpp"

#include "lv/image/lookup.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace lv::image {
namespace {

constexpr int label_count = 256;      ///< of labels from 0 to 255
constexpr int largest_label = 65535;  ///< of few
constexpr int few = 64;               ///< different labels
constexpr double touching = 0.05;     ///< the least share of a border by which labels lie together

/// The labels of a map in order, with 0 whether it occurs or not; empty if its values seem to be
/// none.
std::vector<int> labels_of(const Volume& volume) {
  std::vector<bool> seen(largest_label + 1);
  seen[0] = true;
  for (const float x : volume.values) {
    if (!(x >= 0.0F && x <= static_cast<float>(largest_label)) || x != std::round(x))
      return {};
    seen[static_cast<std::size_t>(x)] = true;
  }
  std::vector<int> labels;
  for (int label = 0; label <= largest_label; ++label)
    if (seen[static_cast<std::size_t>(label)])
      labels.push_back(label);
  const bool small = labels.back() < label_count;
  return small || labels.size() <= few ? labels : std::vector<int>{};
}

/// How long the border of each label with each other one is, in edges of pixels, and how many
/// pixels it has. Labels are counted: the k-th of labels_of is k.
struct Borders {
  std::vector<std::array<double, label_count>> with{label_count};
  std::array<double, label_count> pixels{};

  [[nodiscard]] double length(int label) const {
    return std::accumulate(with[label].begin(), with[label].end(), 0.0);
  }
  /// The part of a label's border that is with others.
  [[nodiscard]] double share(int label, const std::vector<int>& others) const {
    double sum = 0.0;
    for (const int other : others)
      sum += with[label][other];
    return sum == 0.0 ? 0.0 : sum / length(label);
  }
  /// The label, background apart, that has most of a label's border.
  [[nodiscard]] int neighbour(int label) const {
    const auto& row = with[label];
    return static_cast<int>(std::max_element(row.begin() + 1, row.end()) - row.begin());
  }
};

void count_plane(const Picture& picture, const std::vector<int>& labels, Borders& borders) {
  const int columns = picture.plane.columns;
  const int rows = picture.plane.rows;
  const auto label = [&](int i, int j) {
    const int value = static_cast<int>(picture.values[static_cast<std::size_t>(j) * columns + i]);
    return static_cast<int>(std::lower_bound(labels.begin(), labels.end(), value) - labels.begin());
  };
  const auto meet = [&](int a, int b) {
    if (a == b)
      return;
    borders.with[a][b] += 1.0;
    borders.with[b][a] += 1.0;
  };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      borders.pixels[label(i, j)] += 1.0;
      if (i + 1 < columns)
        meet(label(i, j), label(i + 1, j));
      if (j + 1 < rows)
        meet(label(i, j), label(i, j + 1));
    }
}

Borders borders_of(const Volume& volume, const std::vector<int>& labels) {
  Borders borders;
  for (int f = 0; f < volume.frames; ++f)
    for (const Picture& picture : slices(volume, slice_axis(volume), f))
      count_plane(picture, labels, borders);
  return borders;
}

/// The largest label for which something holds; 0 if there is none.
template <class Holds>
int largest(const Borders& borders, const Holds& holds) {
  int best = 0;
  for (int label = 1; label < label_count; ++label)
    if (borders.pixels[label] > 0.0 && holds(label) &&
        (best == 0 || borders.pixels[label] > borders.pixels[best]))
      best = label;
  return best;
}

/// The pixels of the label round another one, per edge between them: how thick that wall is.
double wall_thickness(const Borders& borders, int label) {
  const int wall = borders.neighbour(label);
  return borders.pixels[wall] / borders.with[label][wall];
}

/// 0 if there is none. Of two ventricles with a wall each it is the one with the thicker wall.
int cavity_of(const Borders& borders) {
  const auto has_wall = [&](int label) {
    return borders.share(label, {0}) < 1.0 / 3.0 &&
           borders.share(label, {borders.neighbour(label)}) >= 0.5;
  };
  const int first = largest(borders, has_wall);
  if (first == 0)
    return 0;
  const std::vector<int> taken{first, borders.neighbour(first)};
  const int other = largest(borders, [&](int label) {
    return !is_one_of(label, taken) && !is_one_of(borders.neighbour(label), taken) &&
           has_wall(label);
  });
  return other != 0 && wall_thickness(borders, other) > wall_thickness(borders, first) ? other
                                                                                       : first;
}

/// Whether a label that lies on cavity and muscle is of the wall itself. A patch across the whole
/// wall has about as much border outside as on the cavity, or twice as much in a small heart; an
/// atrium or a vessel has most of its border outside.
bool is_patch(const Borders& borders, int label, int cavity) {
  const double outside = borders.share(label, {0});
  return outside < 0.5 || outside < 2.0 * borders.share(label, {cavity});
}

/// Adds scar and its core to the muscle.
void add_scar(const Borders& borders, int cavity, std::vector<int>& muscle) {
  constexpr double some = 0.1;
  constexpr double most = 0.7;
  const int healthy = muscle.front();
  for (int label = 1; label < label_count; ++label)
    if (borders.pixels[label] > 0.0 && label != cavity && label != healthy &&
        is_patch(borders, label, cavity) && borders.share(label, {cavity}) > some &&
        borders.share(label, {healthy}) > touching)
      muscle.push_back(label);
  const std::vector<int> wall = muscle;
  for (int label = 1; label < label_count; ++label)
    if (borders.pixels[label] > 0.0 && label != cavity && !is_one_of(label, wall) &&
        borders.share(label, wall) > most)
      muscle.push_back(label);
}

}  // namespace

bool seems_labels(const Volume& v) {
  return !labels_of(v).empty();
}

LabelMeaning propose_meaning(const Volume& volume) {
  const std::vector<int> labels = labels_of(volume);
  if (labels.empty())
    return {};
  const Borders borders = borders_of(volume, labels);
  const int cavity = cavity_of(borders);
  if (cavity == 0)
    return {};
  LabelMeaning meaning{{cavity}, {borders.neighbour(cavity)}, {}};
  add_scar(borders, cavity, meaning.muscle);
  const int right = largest(borders, [&](int label) {
    return label != cavity && !is_one_of(label, meaning.muscle) &&
           borders.share(label, meaning.muscle) > touching;
  });
  if (right != 0)
    meaning.right_ventricle = {right};
  for (auto* places : {&meaning.cavity, &meaning.muscle, &meaning.right_ventricle})
    for (int& label : *places)
      label = labels[static_cast<std::size_t>(label)];
  return meaning;
}

}  // namespace lv::image
