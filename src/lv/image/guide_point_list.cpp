#include "lv/image/guide_point_list.hpp"

#include "lv/base/check.hpp"
#include "lv/base/files.hpp"
#include "lv/base/lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <tuple>

namespace lv::image {
namespace {

namespace fs = std::filesystem;

constexpr double largest_coordinate = 1e7;  // more than a ventricle in micrometres
constexpr const char* column_rule =
    "The first line names the columns x, y, z, contour type, slice (or sliceID, frameID) and time "
    "frame, separated by tabs";

/// A column's name without what writers differ in: capitals, blanks, underscores.
std::string plain(std::string_view text) {
  std::string result;
  for (const char c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// The fields of a line, without quotation marks.
std::vector<std::string_view> columns_of(std::string_view line) {
  std::vector<std::string_view> fields = fields_of(line, '\t');
  for (std::string_view& field : fields)
    if (field.size() > 1 && field.front() == '"' && field.back() == '"')
      field = trimmed(field.substr(1, field.size() - 2));
  return fields;
}

/// The file, line by line.
class List {
 public:
  explicit List(const fs::path& file) : file_(file.string()), lines_(file, Columns::any) {
    if (!lines_.is_open())
      throw InputError(file_, "the list of points cannot be opened: " + unreadable(file),
                       "Check the name and that it can be read");
    read_header();
  }

  std::vector<GuidePoint> points() {
    std::vector<GuidePoint> points;
    while (lines_.next())
      points.push_back(point());
    if (points.empty())
      throw InputError(file_, "the list holds no points", "Write one point a line");
    return points;
  }

 private:
  void read_header() {
    if (!lines_.next())
      throw InputError(file_, "the list of points is empty", column_rule);
    const auto fields = columns_of(lines_.text());
    width_ = fields.size();
    std::vector<std::string> header;
    for (const std::string_view field : fields)
      header.push_back(plain(field));
    const auto column = [&](const std::vector<std::string>& names) {
      for (const std::string& name : names)
        if (const auto found = std::find(header.begin(), header.end(), name);
            found != header.end()) {
          if (std::find(found + 1, header.end(), name) != header.end())
            throw InputError(lines_.where(), fmt::format("column \"{}\" is there twice", name),
                             "Keep one of the columns");
          return static_cast<int>(found - header.begin());
        }
      return -1;
    };
    // "frameID" of some writers numbers the images, not the times
    at_ = {column({"x"}),
           column({"y"}),
           column({"z"}),
           column({"contourtype", "type"}),
           column({"slice", "sliceid", "frameid"}),
           column({"timeframe", "frame", "time"}),
           column({"weight"})};
    const std::array<const char*, 5> needed{"x", "y", "z", "contour type", "slice"};
    for (std::size_t c = 0; c < needed.size(); ++c)
      if (at_[c] < 0)
        throw InputError(lines_.where(), fmt::format("column \"{}\" is missing", needed[c]),
                         column_rule);
  }

  [[nodiscard]] GuidePoint point() const {
    auto fields = columns_of(lines_.text());
    while (fields.size() > width_ && fields.back().empty())
      fields.pop_back();
    if (fields.size() != width_)
      throw InputError(lines_.where(),
                       fmt::format("{} values in a table of {} columns", fields.size(), width_),
                       "Give every line one value per column, separated by tabs");
    GuidePoint point;
    point.line = lines_.number();
    for (int d = 0; d < 3; ++d)
      point.x[d] = coordinate(fields[at_[d]]);
    point.type = fields[at_[3]];
    point.slice = whole(fields[at_[4]]);
    point.frame = at_[5] < 0 ? 0 : whole(fields[at_[5]]);
    point.weight = at_[6] < 0 ? 1.0 : number(fields[at_[6]], "Give every point a weight, as 1");
    return point;
  }

  [[nodiscard]] double number(std::string_view text,
                              const char* remedy = "Give positions in scanner millimetres") const {
    const auto value = number_of<double>(text);
    if (!value || !std::isfinite(*value))
      throw InputError(lines_.where(), why_no_number(text, "is not a finite number"), remedy);
    return *value;
  }

  [[nodiscard]] double coordinate(std::string_view text) const {
    const double value = number(text);
    if (std::abs(value) > largest_coordinate)
      throw InputError(lines_.where(), fmt::format("\"{}\" is no place in a scanner", text),
                       "Give positions in scanner millimetres");
    return value;
  }

  /// Whole numbers are also written as 3.0 or 3.0000.
  [[nodiscard]] int whole(std::string_view text) const {
    const double value = number(text);
    if (value != std::round(value) || std::abs(value) > 1e9)
      throw InputError(lines_.where(), fmt::format("\"{}\" is not a whole number", text),
                       "Number slices and times 0, 1, 2 and so on");
    return static_cast<int>(value);
  }

  std::string file_;
  LineReader lines_;
  std::size_t width_ = 0;
  std::array<int, 7> at_{};
};

/// Points that their writer put out of use.
void drop_weightless(std::vector<GuidePoint>& points, const std::string& file,
                     std::vector<std::string>& notes) {
  const auto before = points.size();
  std::erase_if(points, [](const GuidePoint& p) { return p.weight <= 0.0; });
  if (points.empty())
    throw InputError(file, "no point of the list has a weight above 0",
                     "Points of weight 0 are not used: give those that count a weight of 1");
  if (points.size() < before)
    notes.push_back(fmt::format("{} point{} of weight 0 or less: not used", before - points.size(),
                                before - points.size() == 1 ? "" : "s"));
}

void drop_repeated(std::vector<GuidePoint>& points, std::vector<std::string>& notes) {
  constexpr double per_mm = 1e3;  // micrometres
  std::set<std::tuple<std::string, int, int, long long, long long, long long>> seen;
  const auto before = points.size();
  std::erase_if(points, [&](const GuidePoint& p) {
    const auto at = [&](int d) { return std::llround(per_mm * p.x[d]); };
    return !seen.emplace(p.type, p.slice, p.frame, at(0), at(1), at(2)).second;
  });
  if (points.size() < before)
    notes.push_back(fmt::format("{} point{} given twice count once", before - points.size(),
                                before - points.size() == 1 ? "" : "s"));
}

using Times = std::map<int, std::set<int>>;

/// The times that each image bears.
Times times_of(const std::vector<GuidePoint>& points) {
  Times times;
  for (const GuidePoint& p : points)
    times[p.slice].insert(p.frame);
  return times;
}

bool one_time_each(const Times& times) {
  return std::all_of(times.begin(), times.end(),
                     [](const auto& image) { return image.second.size() == 1; });
}

/// The times that short-axis loops bear; all, if there are no loops.
std::set<int> times_of_loops(const std::vector<GuidePoint>& points) {
  std::set<int> of_loops, all;
  for (const GuidePoint& p : points) {
    all.insert(p.frame);
    if (p.type.starts_with("SAX_LV_"))
      of_loops.insert(p.frame);
  }
  return of_loops.empty() ? all : of_loops;
}

/// The one that most images bear.
int commonest(const Times& times, const std::set<int>& choice) {
  const auto images = [&](int time) {
    return std::count_if(times.begin(), times.end(),
                         [&](const auto& image) { return image.second.contains(time); });
  };
  return *std::max_element(choice.begin(), choice.end(),
                           [&](int a, int b) { return images(a) < images(b); });
}

void note_other_times(const std::vector<GuidePoint>& points, int frame,
                      std::vector<std::string>& notes) {
  for (const auto& [slice, times] : times_of(points))
    if (!times.contains(frame))
      notes.push_back(
          fmt::format("slice {} bears the time frame {} where others bear {}, and no other: taken "
                      "to be of the same time",
                      slice, *times.begin(), frame));
}

}  // namespace

std::vector<GuidePoint> read_guide_point_list(const fs::path& file,
                                              std::vector<std::string>& notes) {
  std::vector<GuidePoint> points = List(file).points();
  drop_weightless(points, file.string(), notes);
  drop_repeated(points, notes);
  return points;
}

std::vector<int> times_to_choose(const std::vector<GuidePoint>& points) {
  const Times times = times_of(points);
  const std::set<int> choice = times_of_loops(points);
  if (one_time_each(times))
    return {commonest(times, choice)};
  return {choice.begin(), choice.end()};
}

std::vector<GuidePoint> points_of_time(std::vector<GuidePoint> points, std::optional<int> frame,
                                       const std::string& file, std::vector<std::string>& notes) {
  const Times times = times_of(points);
  const bool one_each = one_time_each(times);
  const std::set<int> choice = times_of_loops(points);
  const auto refuse = [&](const std::string& what) {
    throw InputError(file, what,
                     fmt::format("Choose one of the time frames {}", fmt::join(choice, ", ")));
  };
  if (frame && !choice.contains(*frame))
    refuse(fmt::format("has no points of the time frame {}", *frame));
  if (!frame && choice.size() > 1 && !one_each)
    refuse(fmt::format("has points of {} times", choice.size()));
  const int chosen = frame.value_or(commonest(times, choice));
  std::erase_if(points, [&](const GuidePoint& p) {
    const bool own = times.at(p.slice).size() == 1 && (one_each || !choice.contains(p.frame));
    return p.frame != chosen && !own;
  });
  note_other_times(points, chosen, notes);
  return points;
}

}  // namespace lv::image
