#include "lv/draw/draw.hpp"

#include "lv/base/check.hpp"
#include "lv/base/files.hpp"
#include "lv/base/interrupt.hpp"
#include "lv/base/lines.hpp"
#include "lv/base/names_alone.hpp"
#include "lv/base/printable.hpp"
#include "lv/base/table.hpp"
#include "lv/draw/browser.hpp"
#include "lv/draw/bundle.hpp"
#include "lv/draw/enhancement_json.hpp"
#include "lv/draw/server.hpp"
#include "lv/draw/study.hpp"
#include "lv/draw/study_json.hpp"
#include "lv/page/packing.hpp"
#include "lv/page/place.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include <optional>
#include <string_view>

namespace lv::draw {
namespace {

namespace fs = std::filesystem;

Answer refused(unsigned status, const std::string& why) {
  return {status, "application/json", nlohmann::json{{"error", why}}.dump()};
}

Answer keep(Study& study, const std::string& body, bool whatever_stands) {
  Kept kept = read_kept(body, study);
  if (!whatever_stands) {
    if (kept.revision != study.revision)
      return refused(409, "another tab has saved since this one was opened");
    if (const auto file = changed_elsewhere(study))
      return refused(409, fmt::format("{} has changed since it was read or saved here: another "
                                      "ventricle draw, or another program, has been in {}",
                                      printable(file->filename().string()),
                                      printable(study.folder.filename().string())));
  }
  save(study, std::move(kept.drawing), std::move(kept.scar));
  return {200, "application/json",
          nlohmann::json{{"revision", study.revision}, {"faults", faults_of(study.drawing.lines)}}
              .dump()};
}

/// What `bytes` makes of the number of one of so many slices.
template <class Bytes>
Answer slice_of(std::size_t slices, std::string_view number, const Bytes& bytes) {
  const auto slice = number_of<int>(number);
  if (!slice || *slice < 1 || *slice > static_cast<int>(slices))
    return refused(404, "there is no such slice");
  return {200, "application/octet-stream", bytes(*slice)};
}

std::string enhanced_bytes(const Enhancement& enhancement, int number) {
  return grey_bytes(enhancement.image.slices[static_cast<std::size_t>(number - 1)],
                    enhancement.greys);
}

/// Where the wall lies on the enhanced slices, and the scar in it.
std::optional<std::string> of_scar(const Study& study, const Request& request) {
  if (!study.enhancement)
    return std::nullopt;
  const image::Cine& image = study.enhancement->image;
  if (request.place == "wall")
    return walls_text(walls_on(study.settings, image, read_wall_lines(request.body, study)));
  if (request.place == "scar")
    return scar_map_text(propose_scar(study.settings, image, read_scar_wish(request.body, study)),
                         image);
  return std::nullopt;
}

std::string redrawn(const Study& study, const std::string& body) {
  const Redrawn asked = read_wish(body, study);
  const double set = study.settings.anatomy.cine.segmentation.fall;
  return points_json(segment::redraw(study.cine.slices[asked.slice], asked.wish,
                                     set == 0.0 ? study.proposal.fall : set, "what the page sent"));
}

Answer shown(Study& study, const std::string& place) {
  constexpr std::string_view slices = "slice/";
  constexpr std::string_view enhanced = "enhanced/";
  if (place.empty())
    return {200, "text/html; charset=utf-8", std::string(page_bundle())};
  if (place == "study") {
    catch_up(study);
    return {200, "application/json", study_json(study)};
  }
  if (place == "alive")
    return {200, "application/json", nlohmann::json{{"revision", study.revision}}.dump()};
  if (place.starts_with(slices))
    return slice_of(study.pictures(), std::string_view(place).substr(slices.size()),
                    [&](int number) { return picture_bytes(study, number); });
  if (place.starts_with(enhanced) && study.enhancement)
    return slice_of(study.enhancement->image.slices.size(),
                    std::string_view(place).substr(enhanced.size()),
                    [&](int number) { return enhanced_bytes(*study.enhancement, number); });
  return refused(404, "there is nothing of this name");
}

/// All that the page asks for.
Answer answer(Study& study, const Request& request) {
  const std::string& place = request.place;
  if (request.method == "GET")
    return shown(study, place);
  if (place == "save" || place == "overwrite")
    return keep(study, request.body, place == "overwrite");
  if (place == "segment") {
    const Proposal found = propose(study, read_centre(request.body));
    study.proposal.fall = found.fall;
    return {200, "application/json", proposal_json(found)};
  }
  if (place == "redraw")
    return {200, "application/json", redrawn(study, request.body)};
  if (auto text = of_scar(study, request))
    return {200, "application/json", std::move(*text)};
  return refused(404, "there is nothing of this name");
}

/// zlib's format (RFC 1950), as browsers unpack it.
std::string packed(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  LV_CHECK(compress(reinterpret_cast<Bytef*>(out.data()), &size,
                    reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()) == Z_OK);
  out.resize(size);
  return page::base64(out);
}

/// Text that may stand between the tags of a script.
std::string inside_script(std::string text) {
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos; at += 6)
    text.replace(at, 1, "\\u003c");
  return text;
}

std::string page_with(const Study& study) {
  constexpr std::string_view mark = "<!-- study -->";
  const std::string_view bundle = page_bundle();
  const std::size_t at = bundle.find(mark);
  LV_CHECK(at != std::string_view::npos);
  std::string page(bundle.substr(0, at));
  page += "<script type=\"application/json\" id=\"study\">" + inside_script(study_json(study)) +
          "</script>\n";
  const auto pictures = [&](const char* id, std::size_t count, const auto& bytes) {
    for (int number = 1; number <= static_cast<int>(count); ++number)
      page += fmt::format("<script type=\"text/plain\" id=\"{}-{}\">{}</script>\n", id, number,
                          packed(bytes(number)));
  };
  pictures("slice", study.pictures(), [&](int number) { return picture_bytes(study, number); });
  if (study.enhancement)
    pictures("enhanced", study.enhancement->image.slices.size(),
             [&](int number) { return enhanced_bytes(*study.enhancement, number); });
  page += bundle.substr(at + mark.size());
  return page;
}

void serve(Study& study, bool browser) {
  const NamesAlone names({fs::absolute(study.folder).parent_path(), study.folder.parent_path()});
  std::optional<OpenPage> page;  // until the browser has come: its file need not stay
  Server server([&](const Request& request) {
    if (request.place.empty())
      page.reset();
    try {
      return answer(study, request);
    } catch (const InputError& error) {
      return refused(400, names(error.what()));
    } catch (const RunError& error) {
      return refused(500, names(error.what()));
    }
  });
  print(
      fmt::format("{}\nThis address works on this machine alone, until Ctrl-C ends this program. "
                  "What is saved goes to {}\n",
                  server.address(), study.folder.string()));
  page.emplace(browser ? server.address() : "");
  server.run();
  print("ended\n");
}

}  // namespace

void run(const case_file::Case& c, const Options& options) {
  fs::path folder = options.folder;
  if (folder.empty())
    folder = c.file.parent_path() / (c.file.stem().string() + ".draw");
  if (!options.page.empty())
    page::require_place(options.page);
  Study study = open_study(c, folder);
  if (!options.drawing.empty()) {
    require_readable(options.drawing, "Name what the page let you download");
    Kept kept = read_kept(read_file(options.drawing), study);
    save(study, std::move(kept.drawing), std::move(kept.scar));
    print(fmt::format("wrote {}\n", folder.string()));
    for (const std::string& fault : faults_of(study.drawing.lines))
      print(fmt::format("note: {}\n", fault));
  } else if (!options.page.empty()) {
    write_file(options.page, page_with(study));
    print(fmt::format("wrote {}; it shows the images, so treat it as you treat them\n",
                      options.page.string()));
  } else {
    serve(study, options.browser);
  }
}

}  // namespace lv::draw
