#pragma once

#include <complex>
#include <memory>
#include <vector>

struct fftw_plan_s;

namespace lv::fluid {

/// Real transforms of many lines at once, between points along an axis and the modes of that axis:
///
///   sine    (cell centres, odd about the ends):   f_j = 2 sum_m' F_m sin(pi m (j+1/2)/N),  m = 1..N
///   cosine  (faces, even about the ends):         f_j = 2 sum_m' F_m cos(pi m j/N),        m = 0..N
///
/// where sum' halves the terms m = 0 and m = N. to_points(to_modes(f)) = 2N f: the caller divides
/// by 2N per axis.
///
/// A tile holds `columns` lines side by side. Neighbouring columns are the real and imaginary part
/// of one complex line, so that FFTW's complex transforms, which use the SIMD units fully where its
/// real ones do not, do the work (sine: Makhoul, IEEE Trans. ASSP 28:27, 1980; cosine: Cooley,
/// Lewis & Welch, J. Sound Vib. 12:315, 1970).
class LineTransform {
 public:
  enum class Kind { sine, cosine };

  /// `cells` = N; `columns` even.
  LineTransform(Kind kind, int cells, int columns);
  ~LineTransform();
  LineTransform(LineTransform&&) noexcept;
  LineTransform& operator=(LineTransform&&) = delete;

  /// Values along a line: N for sine, N+1 for cosine.
  [[nodiscard]] int points() const { return kind_ == Kind::sine ? cells_ : cells_ + 1; }
  [[nodiscard]] int columns() const { return columns_; }

  /// Copies `count` <= columns() numbers, `stride` apart in memory, into or out of the tile: point
  /// j or mode number m of each line, counted from 0 (so sine mode m is stored as m - 1). Loading
  /// sets the other columns to zero.
  void load_point(int j, const double* from, int count);
  void load_mode(int m, const double* from, int count);
  void store_point(int j, double* to, int count, int stride = 1) const;
  void store_mode(int m, double* to, int count, int stride = 1) const;

  void to_modes();
  void to_points();

 private:
  [[nodiscard]] double* in(int r) const;
  [[nodiscard]] double* out(int r) const;
  [[nodiscard]] const double* result(int r) const;
  [[nodiscard]] int row_of_point(int j) const;
  [[nodiscard]] int row_of_mode(int m) const;
  [[nodiscard]] double sign_of_point(int j) const;
  void clear_rest(double* row, int count) const;
  void sine_to_modes();
  void sine_to_points();
  void cosine();
  void cosine_fold();
  void cosine_unfold();

  struct Plans;
  Kind kind_;
  int cells_;
  int columns_;
  std::vector<std::complex<double>> twiddle_;
  std::vector<double> first_odd_;  ///< cosine mode 1 of every line
  std::unique_ptr<Plans> plans_;
};

}  // namespace lv::fluid
