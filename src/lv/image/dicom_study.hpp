#pragma once

#include "lv/base/files.hpp"
#include "lv/image/dicom_file.hpp"
#include "lv/image/picture.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lv::image {

/// The images of one slice in order of time.
struct DicomSlice {
  double position = 0.0;  ///< along the stack's normal [mm]
  std::vector<DicomImage> images;
};

/// A file that would be an image but is left out.
struct LostImage {
  LeftOut file;
  std::optional<int> instance;  ///< its InstanceNumber, if it could be read
};

/// Parallel slices of one series with one kind of image: what a user chooses from. A series with
/// several orientations is several stacks.
struct DicomStack {
  std::string key;  ///< by which a case names it: the series' number, with #2 for a second stack of
                    ///< a series; the SeriesInstanceUID where numbers are missing or repeated
  std::string series_uid, description, kind;
  Vec3 normal = Vec3::UnitZ();
  std::vector<DicomSlice> slices;    ///< along the normal
  std::vector<std::string> notes{};  ///< of a chosen stack: what of the study a user should know
  std::vector<LostImage> lost{};     ///< of a chosen stack: images of the study, whatever series
};

/// All that some files hold.
struct DicomStudy {
  std::string where;               ///< the first of the files and folders, for messages
  std::vector<DicomStack> stacks;  ///< by series number, UID and orientation
  std::vector<LeftOut> skipped;    ///< files that are not used
  std::vector<LostImage> lost;     ///< those of them that would be images
  std::vector<std::string> notes;  ///< what a user should know of its files
};

/// Reads the headers of files and of all files in folders, whatever their names; for links see
/// lv::files_in. Images that are there twice (the same SOPInstanceUID, place, time and pixels)
/// count once; what is no DICOM image with a place in space is skipped with its reason. Slices are
/// told apart by their planes and images of a slice ordered by trigger time, else temporal
/// position, else instance number: the first that all have and that is not the same for all. Throws
/// InputError if a file or folder is absent or cannot be read.
[[nodiscard]] DicomStudy read_dicom_study(std::span<const std::filesystem::path> where);

/// A line per stack: key, description, slices, images per slice, size, spacing, orientation, RR.
[[nodiscard]] std::string describe(const DicomStudy& study);

/// A line per stack, with its key in quotation marks and its description: to choose from.
[[nodiscard]] std::string choices(const DicomStudy& study);

/// Throws InputError with the reasons why files were skipped unless there is a stack; `where` names
/// the files.
void require_images(const DicomStudy& study, const std::string& where);

/// Whether a name that a user gives chooses a stack of a study: a key, a series number, a
/// SeriesInstanceUID or a description (then all series that bear it).
[[nodiscard]] bool is_chosen(const DicomStudy& study, const DicomStack& stack,
                             const std::string& name);

/// The stacks that a user names (is_chosen), joined to one. Without names there must be
/// one stack only. `where` and `parameter` are for messages. Throws InputError with the list of
/// stacks where a name fits none, where there are several to choose from, where the chosen ones are
/// not parallel, or where two images show the same slice at the same time, nothing orders the
/// images of a slice in time, or a slice has several times as many as the headers announce.
[[nodiscard]] DicomStack choose_stack(const DicomStudy& study, std::span<const std::string> series,
                                      const std::string& where, const std::string& parameter);

/// What a user should know of a stack: files left out, several patients, slices that cannot be used
/// as they are, gaps and steps between slices, differing heart rates, differing numbers of images,
/// slices with other pixels, pixels of no usual size, damaged files.
[[nodiscard]] std::vector<std::string> remarks(const DicomStack& stack);

/// The images of a stack with their pixels.
[[nodiscard]] Cine read_pixels(const DicomStack& stack);

/// A cine stack, or any stack of images, from files and folders; see read_dicom_study and
/// choose_stack. The notes are those of remarks.
[[nodiscard]] Cine read_dicom_cine(std::span<const std::filesystem::path> where,
                                   std::span<const std::string> series = {},
                                   const std::string& parameter = "series");

}  // namespace lv::image
