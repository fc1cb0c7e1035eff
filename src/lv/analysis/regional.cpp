#include "lv/analysis/regional.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lv::analysis {
namespace {

template <class Selected>
Region select(const std::string& scheme, const std::string& name, std::size_t cells,
              const Selected& selected) {
  Region region{scheme, name, {}};
  for (std::size_t c = 0; c < cells; ++c)
    if (selected(c))
      region.cells.push_back(static_cast<int>(c));
  return region;
}

void add_zones(const std::vector<CellFields>& cells, std::vector<Region>& list) {
  constexpr double edge = 1e-9;
  const auto M = [&](std::size_t c) { return cells[c].infarct; };
  const std::size_t n = cells.size();
  if (std::none_of(cells.begin(), cells.end(),
                   [](const CellFields& c) { return c.infarct > edge; }))
    return;
  list.push_back(select("zone", "infarct", n, [&](auto c) { return M(c) >= 1.0 - edge; }));
  list.push_back(
      select("zone", "border", n, [&](auto c) { return M(c) > edge && M(c) < 1.0 - edge; }));
  list.push_back(select("zone", "remote", n, [&](auto c) { return M(c) <= edge; }));
}

}  // namespace

std::vector<CellQuantity> cell_quantities(const std::vector<CellFields>& now,
                                          const std::vector<CellFields>& then) {
  std::vector<CellStrain> strains;
  for (std::size_t c = 0; c < now.size(); ++c)
    strains.push_back(then.empty() ? strain(now[c]) : strain(now[c], then[c]));
  std::vector<CellQuantity> all;
  for (const Quantity& q : quantities()) {
    if (!is_known(q, now))
      continue;
    std::vector<double> values;
    for (std::size_t c = 0; c < now.size(); ++c)
      values.push_back(q.of(now[c], strains[c]));
    all.push_back({&q, std::move(values)});
  }
  return all;
}

std::vector<Region> region_list(const mesh::Regions& regions,
                                const std::vector<CellFields>& cells) {
  const std::size_t n = cells.size();
  const auto& slice = regions.slice;
  std::vector<Region> list;
  list.push_back(select("whole", "wall", n, [](auto) { return true; }));
  list.push_back(select("third", "basal", n, [&](auto c) { return slice[c] <= 2; }));
  list.push_back(
      select("third", "middle", n, [&](auto c) { return slice[c] >= 3 && slice[c] <= 5; }));
  list.push_back(select("third", "apical", n, [&](auto c) { return slice[c] >= 6; }));
  for (int s = 1; s <= mesh::slice_count; ++s)
    list.push_back(select("slice", std::to_string(s), n, [&](auto c) { return slice[c] == s; }));
  for (int s = 1; s <= mesh::slice_count; ++s)
    for (int k = 1; k <= mesh::sectors_of_slice(s); ++k)
      list.push_back(select("sector", fmt::format("{} {}", s, mesh::sector_name(s, k)), n,
                            [&](auto c) { return slice[c] == s && regions.sector[c] == k; }));
  for (int a = 1; a <= 17; ++a)
    list.push_back(select("aha17", fmt::format("{} {}", a, mesh::aha_name(a)), n,
                          [&](auto c) { return regions.aha[c] == a; }));
  add_zones(cells, list);
  return list;
}

Statistics statistics(const std::vector<double>& values, const std::vector<CellFields>& cells,
                      const std::vector<int>& members) {
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  if (members.empty())
    return {missing, missing, missing, missing, missing};
  std::vector<int> sorted = members;
  std::sort(sorted.begin(), sorted.end(), [&](int a, int b) { return values[a] < values[b]; });
  double volume = 0.0;
  double sum = 0.0;
  for (const int c : sorted) {
    volume += cells[c].volume;
    sum += cells[c].volume * values[c];
  }
  const double mean = sum / volume;
  double squares = 0.0;
  for (const int c : sorted)
    squares += cells[c].volume * (values[c] - mean) * (values[c] - mean);
  const auto percentile = [&](double fraction) {
    double below = 0.0;
    for (const int c : sorted) {
      below += cells[c].volume;
      if (below >= fraction * volume)
        return values[c];
    }
    return values[sorted.back()];
  };
  return {mean, std::sqrt(squares / volume), percentile(0.01), percentile(0.5), percentile(0.99)};
}

double rotation(const std::vector<CellFields>& now, const std::vector<CellFields>& then,
                const std::vector<int>& members) {
  double volume = 0.0;
  Vec3 centre_now = Vec3::Zero();
  Vec3 centre_then = Vec3::Zero();
  for (const int c : members) {
    volume += now[c].volume;
    centre_now += now[c].volume * now[c].position;
    centre_then += now[c].volume * then[c].position;
  }
  if (members.empty())
    return std::numeric_limits<double>::quiet_NaN();
  centre_now /= volume;
  centre_then /= volume;
  double cross = 0.0;
  double dot = 0.0;
  for (const int c : members) {
    const Vec3 x = now[c].position - centre_now;
    const Vec3 X = then[c].position - centre_then;
    cross += now[c].volume * (X.x() * x.y() - X.y() * x.x());
    dot += now[c].volume * (X.x() * x.x() + X.y() * x.y());
  }
  return -std::atan2(cross, dot);  // seen from the apex, the other way round than from the base
}

}  // namespace lv::analysis
