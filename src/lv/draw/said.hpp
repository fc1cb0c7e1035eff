#pragma once

#include "lv/base/check.hpp"
#include "lv/draw/study.hpp"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <vector>

/// What a page says, read and checked. All throw InputError for what no page of ours would send, or
/// nlohmann's exceptions, of which from_text makes one.
namespace lv::draw {

inline constexpr const char* what_page = "what the page sent";
inline constexpr const char* reload = "Reload the page, and draw again what is wrong";

/// What `use` makes of a text.
template <class Use>
auto from_text(const std::string& text, const Use& use) {
  try {
    return use(nlohmann::json::parse(text));
  } catch (const nlohmann::json::exception&) {
    throw InputError(what_page, "is no drawing", reload);
  }
}

/// Where a slice lies, as the page takes it.
[[nodiscard]] nlohmann::json plane_json(const image::CineSlice& slice);

/// Where the slices of a stack lie.
[[nodiscard]] nlohmann::json planes_json(const image::Cine& cine);

[[nodiscard]] Vec3 said_point(const nlohmann::json& x);

/// A number from 1 to `most`.
[[nodiscard]] int said_number(const nlohmann::json& object, const char* name, std::size_t most);

/// A word that an observer typed: one line that is short.
[[nodiscard]] std::string said_word(const nlohmann::json& object, const char* name);

/// Who drew something, when, and whether it was proposed, corrected or drawn.
[[nodiscard]] geometry::Provenance said_provenance(const nlohmann::json& object);

/// "endo" or "epi".
[[nodiscard]] geometry::Side said_side(const nlohmann::json& object);

/// Throws InputError for a point that lies off a slice or a long-axis image (Study::picture).
void check_on_slice(const Vec3& x, int number, const Study& study);

/// So many points of a slice of the cine.
[[nodiscard]] std::vector<Vec3> said_points(const nlohmann::json& all, int slice,
                                            const Study& study, std::size_t fewest,
                                            std::size_t most);

inline constexpr std::size_t fewest_of_line = 3;
inline constexpr std::size_t most_of_line = 2000;

/// A closed line of the cine.
[[nodiscard]] geometry::Contour said_line(const nlohmann::json& object, const Study& study);

}  // namespace lv::draw
