#include "support/mutations.hpp"

#include "lv/base/check.hpp"

#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string_view>

namespace lv::test {
namespace {

/// What takes longer is taken to hang: of processor time where it computes, of time where it waits,
/// for other programs may have the processors.
constexpr unsigned longest = 60;  // [s]
constexpr unsigned longest_wait = 10 * longest;

/// A signal ends the tests when its object lives too long.
class Watch {
 public:
  Watch() {
    alarm(longest_wait);
    set(longest);
  }
  ~Watch() {
    alarm(0);
    set(0);
  }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

 private:
  static void set(unsigned seconds) {
    const itimerval timer{{0, 0}, {static_cast<time_t>(seconds), 0}};
    setitimer(ITIMER_PROF, &timer, nullptr);
  }
};

/// Not more than 4 GB besides what is in use, as long as the object lives.
class MemoryLimit {
 public:
  MemoryLimit() {
#ifndef __SANITIZE_ADDRESS__  // which has a limit of its own
    getrlimit(RLIMIT_AS, &before_);
    rlim_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlim_t most = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + (rlim_t{4} << 30U);
    const rlimit limit{std::min(most, before_.rlim_max), before_.rlim_max};
    setrlimit(RLIMIT_AS, &limit);
#endif
  }
  ~MemoryLimit() {
#ifndef __SANITIZE_ADDRESS__
    setrlimit(RLIMIT_AS, &before_);
#endif
  }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
  rlimit before_{};
};

/// Replaces a number that is written in digits.
void replace_number(std::string& bytes, std::size_t at, std::mt19937& random) {
  constexpr std::array<std::string_view, 14> absurd{"nan",
                                                    "inf",
                                                    "-inf",
                                                    "1e308",
                                                    "-1e308",
                                                    "1e-320",
                                                    "-1",
                                                    "0",
                                                    "",
                                                    "2147483647",
                                                    "-2147483648",
                                                    "99999999999",
                                                    "9223372036854775807",
                                                    "1e999"};
  constexpr std::string_view digits = "0123456789+-.eE";
  const std::size_t begin = bytes.find_first_of("0123456789", at);
  if (begin == std::string::npos)
    return;
  const std::size_t end = std::min(bytes.find_first_not_of(digits, begin), bytes.size());
  bytes.replace(begin, end - begin, absurd[random() % absurd.size()]);
}

/// Writes a number as files without digits have it.
template <class Number>
void write_number(std::string& bytes, std::size_t at, std::mt19937& random) {
  using Limits = std::numeric_limits<Number>;
  const std::array<Number, 6> absurd{Limits::max(),       Limits::lowest(),
                                     Number{0},           static_cast<Number>(-1),
                                     Limits::quiet_NaN(), Limits::infinity()};
  const Number number = absurd[random() % absurd.size()];
  const std::string_view raw(reinterpret_cast<const char*>(&number), sizeof(number));
  at -= at % 2;
  bytes.replace(at, std::min(raw.size(), bytes.size() - at), raw.substr(0, bytes.size() - at));
}

void damage_once(std::string& bytes, std::size_t at, std::mt19937& random) {
  const std::size_t length = random() % 40;
  const std::string piece = bytes.substr(random() % bytes.size(), random() % 200);
  switch (random() % 10) {
    case 0:
      bytes[at] = static_cast<char>(random());
      break;
    case 1:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
      break;
    case 2:
      bytes.erase(at, length);
      break;
    case 3:
      bytes.insert(at, std::string(length, static_cast<char>(random())));
      break;
    case 4:
      bytes.insert(at, piece);
      break;
    case 5:
      bytes.replace(at, std::min(piece.size(), bytes.size() - at), piece);
      break;
    case 6:
      bytes.resize(at);
      break;
    case 7:
      random() % 2 == 0 ? write_number<std::int32_t>(bytes, at, random)
                        : write_number<std::int16_t>(bytes, at, random);
      break;
    case 8:
      random() % 2 == 0 ? write_number<double>(bytes, at, random)
                        : write_number<float>(bytes, at, random);
      break;
    default:
      replace_number(bytes, at, random);
  }
}

/// What a reader threw that it must not throw; empty if it read the file or refused it.
std::string mistake(const Read& read, const std::filesystem::path& file) {
  const MemoryLimit limit;
  try {
    read(file);
  } catch (const InputError&) {
  } catch (const RunError&) {
  } catch (const std::exception& error) {
    return fmt::format("threw {}", error.what());
  } catch (...) {
    return "threw something strange";
  }
  return {};
}

}  // namespace

int mutations(int few) {
  const char* set = std::getenv("VENTRICLE_MUTATIONS");
  return set != nullptr ? std::atoi(set) : few;
}

std::string mutated(std::string bytes, std::mt19937& random, std::size_t within) {
  const int changes = 1 + static_cast<int>(random() % 4);
  for (int n = 0; n < changes && !bytes.empty() && within > 0; ++n)
    damage_once(bytes, random() % std::min(bytes.size(), within), random);
  return bytes;
}

void try_damaged(const std::string& name, const std::string& bytes, const Read& read,
                 const Damage& damage, const std::function<void(std::string&)>& finish) {
  const TemporaryFolder folder;
  write_bytes(folder / name, bytes);
  REQUIRE_NOTHROW(read(folder / name));
  std::mt19937 random(12345);
  for (int n = 0; n < mutations(damage.few); ++n) {
    std::string copy = mutated(bytes, random, damage.within);
    finish(copy);
    write_bytes(folder / name, copy);
    const std::string wrong = [&] {
      const Watch watch;
      return mistake(read, folder / name);
    }();
    INFO("damaged copy " << n << " of " << name);
    CHECK(wrong == "");
  }
}

}  // namespace lv::test
