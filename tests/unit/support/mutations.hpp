#pragma once

#include <filesystem>
#include <functional>
#include <random>
#include <string>

/// Damaged copies of good files, which readers must read or refuse in words.
namespace lv::test {

/// How many damaged copies each reader is tried on: the environment variable VENTRICLE_MUTATIONS,
/// else `few`.
[[nodiscard]] int mutations(int few);

/// Where a file is damaged: anywhere, or in its first bytes alone.
struct Damage {
  std::size_t within = std::string::npos;  ///< bytes from the beginning
  int few = 30;                            ///< copies that are tried unless more are asked for
};

/// A copy with up to four damages: bytes changed, cut out, put in, repeated or moved, numbers made
/// absurd, the end missing.
[[nodiscard]] std::string mutated(std::string bytes, std::mt19937& random,
                                  std::size_t within = std::string::npos);

using Read = std::function<void(const std::filesystem::path&)>;

/// Tries a reader on a good file, which it must read, and on damaged copies of it, which it must
/// read or refuse by InputError or RunError. Any other exception fails the test; a reader that goes
/// on for a minute, or in builds without the address sanitizer asks for gigabytes, ends it.
/// `name` is the file's; `finish` writes to a damaged copy what a file of the kind cannot lack.
void try_damaged(
    const std::string& name, const std::string& bytes, const Read& read, const Damage& damage = {},
    const std::function<void(std::string&)>& finish = [](std::string&) {});

}  // namespace lv::test
