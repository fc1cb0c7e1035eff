#include "lv/fluid/line_transform.hpp"

#include "lv/base/check.hpp"

#include <Eigen/Core>
#include <fftw3.h>

#include <numbers>

namespace lv::fluid {

/// The tile before and after FFTW's transforms, and their plans. Plans are estimated, not timed, so
/// that every run and every restart rounds in the same way. (In place, FFTW would allocate a buffer
/// at every call.)
struct LineTransform::Plans {
  Plans(int rows, int length, int columns)
      : in(allocate(rows, columns)),
        out(allocate(length, columns)),
        forward(make(length, columns / 2, FFTW_FORWARD)),
        backward(make(length, columns / 2, FFTW_BACKWARD)) {}
  ~Plans() {
    fftw_destroy_plan(forward);
    fftw_destroy_plan(backward);
    fftw_free(in);
    fftw_free(out);
  }
  Plans(const Plans&) = delete;
  Plans& operator=(const Plans&) = delete;

  static double* allocate(int length, int columns) {
    const std::size_t count = static_cast<std::size_t>(length) * columns;
    double* memory = fftw_alloc_real(count);
    std::fill_n(memory, count, 0.0);
    return memory;
  }

  [[nodiscard]] fftw_plan make(int length, int lines, int direction) const {
    return fftw_plan_many_dft(1, &length, lines, reinterpret_cast<fftw_complex*>(in), nullptr,
                              lines, 1, reinterpret_cast<fftw_complex*>(out), nullptr, lines, 1,
                              direction, FFTW_ESTIMATE);
  }

  double* in;
  double* out;
  fftw_plan forward;
  fftw_plan backward;
};

namespace {

using Complex = std::complex<double>;

std::vector<Complex> twiddles(int n) {
  std::vector<Complex> w(n);
  for (int k = 0; k < n; ++k)
    w[k] = std::polar(1.0, -std::numbers::pi * k / (2.0 * n));
  return w;
}

/// a b, without the recovery of infinities that the operator must do and that keeps it from the
/// SIMD units.
Complex product(const Complex& a, const Complex& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// i a.
Complex turned(const Complex& a) {
  return {-a.imag(), a.real()};
}

Complex* complex(double* row) {
  return reinterpret_cast<Complex*>(row);
}

}  // namespace

LineTransform::LineTransform(Kind kind, int cells, int columns)
    : kind_(kind),
      cells_(cells),
      columns_(columns),
      twiddle_(twiddles(cells)),
      first_odd_(columns),
      plans_(std::make_unique<Plans>(points(), cells, columns)) {
  LV_CHECK(cells >= 1 && columns >= 2 && columns % 2 == 0);
}
LineTransform::~LineTransform() = default;
LineTransform::LineTransform(LineTransform&&) noexcept = default;

double* LineTransform::in(int r) const {
  return plans_->in + static_cast<std::ptrdiff_t>(r) * columns_;
}
double* LineTransform::out(int r) const {
  return plans_->out + static_cast<std::ptrdiff_t>(r) * columns_;
}
const double* LineTransform::result(int r) const {
  return kind_ == Kind::cosine ? in(r) : out(r);
}

// Makhoul's order for the sine: the even points forwards, then the odd points backwards with their
// sign changed.
int LineTransform::row_of_point(int j) const {
  if (kind_ == Kind::cosine)
    return j;
  return j % 2 == 0 ? j / 2 : cells_ - 1 - j / 2;
}
double LineTransform::sign_of_point(int j) const {
  return kind_ == Kind::sine && j % 2 != 0 ? -1.0 : 1.0;
}
int LineTransform::row_of_mode(int m) const {
  return kind_ == Kind::sine ? cells_ - 1 - m : m;
}

void LineTransform::load_point(int j, const double* from, int count) {
  double* to = in(row_of_point(j));
  const double sign = sign_of_point(j);
  for (int c = 0; c < count; ++c)
    to[c] = sign * from[c];
  clear_rest(to, count);
}

void LineTransform::load_mode(int m, const double* from, int count) {
  double* to = in(row_of_mode(m));
  std::copy_n(from, count, to);
  clear_rest(to, count);
}

/// What the last transform left in unused columns would be transformed again and again, grow
/// without bound and, through rounding, spoil the line that shares a complex number with it.
void LineTransform::clear_rest(double* row, int count) const {
  std::fill(row + count, row + columns_, 0.0);
}

void LineTransform::store_point(int j, double* to, int count, int stride) const {
  const double* from = result(row_of_point(j));
  const double sign = sign_of_point(j);
  for (int c = 0; c < count; ++c)
    to[static_cast<std::ptrdiff_t>(c) * stride] = sign * from[c];
}

void LineTransform::store_mode(int m, double* to, int count, int stride) const {
  const double* from = result(row_of_mode(m));
  for (int c = 0; c < count; ++c)
    to[static_cast<std::ptrdiff_t>(c) * stride] = from[c];
}

void LineTransform::to_modes() {
  if (kind_ == Kind::cosine)
    cosine();
  else
    sine_to_modes();
}

void LineTransform::to_points() {
  if (kind_ == Kind::cosine)
    cosine();
  else
    sine_to_points();
}

/// C_k = w_k V_k + conj(w_k) V_{N-k}, w_k = exp(-i pi k/2N), is the cosine transform of the
/// reordered line V; sine mode N-k is C_k.
void LineTransform::sine_to_modes() {
  fftw_execute(plans_->forward);
  const int lines = columns_ / 2;
  for (int c = 0; c < columns_; ++c)
    out(0)[c] *= 2.0;
  for (int k = 1; 2 * k <= cells_; ++k) {
    Complex* low = complex(out(k));
    Complex* high = complex(out(cells_ - k));
    const Complex w = twiddle_[k];
    const Complex w_high = twiddle_[cells_ - k];
    for (int c = 0; c < lines; ++c) {
      const Complex a = low[c];
      const Complex b = high[c];
      low[c] = product(w, a) + product(std::conj(w), b);
      high[c] = product(w_high, b) + product(std::conj(w_high), a);
    }
  }
}

/// V_k = conj(w_k) (C_k - i C_{N-k}), C_N = 0, and back through the complex transform.
void LineTransform::sine_to_points() {
  const int lines = columns_ / 2;
  for (int k = 1; 2 * k <= cells_; ++k) {
    Complex* low = complex(in(k));
    Complex* high = complex(in(cells_ - k));
    const Complex w = std::conj(twiddle_[k]);
    const Complex w_high = std::conj(twiddle_[cells_ - k]);
    for (int c = 0; c < lines; ++c) {
      const Complex a = low[c];
      const Complex b = high[c];
      low[c] = product(w, a - turned(b));
      high[c] = product(w_high, b - turned(a));
    }
  }
  fftw_execute(plans_->backward);
}

/// With a_j = x_j + x_{N-j}, d_j = x_j - x_{N-j} and e_j = 2 sin(pi j/N) d_j, the complex transform
/// Y of a + e (length N) holds the even modes, X_2k = (Y_k + Y_{N-k})/2, and the steps between the
/// odd ones, X_{2k+1} - X_{2k-1} = -i (Y_k - Y_{N-k})/2, from X_1 = sum_j d_j cos(pi j/N). The sum
/// over k costs sqrt(N) in rounding. The transform is its own inverse but for the factor 2N.
void LineTransform::cosine() {
  cosine_fold();
  fftw_execute(plans_->forward);
  cosine_unfold();
}

void LineTransform::cosine_fold() {
  double* first = first_odd_.data();
  std::fill_n(first, columns_, 0.0);
  // w_{2j} = exp(-i pi j/N), from the table of w_j for j < N
  for (int j = 0; 2 * j <= cells_; ++j) {
    double* low = in(j);
    double* high = in(cells_ - j);
    const Complex w = product(twiddle_[j], twiddle_[j]);
    const double cosine = j == 0 ? 1.0 : 2 * j == cells_ ? 0.0 : 2.0 * w.real();
    const double sine = -2.0 * w.imag();
    for (int c = 0; c < columns_; ++c) {
      const double a = low[c] + high[c];
      const double d = low[c] - high[c];
      first[c] += cosine * d;
      low[c] = a + sine * d;
      high[c] = a - sine * d;
    }
  }
}

void LineTransform::cosine_unfold() {
  const int lines = columns_ / 2;
  std::copy_n(out(0), columns_, in(0));
  std::copy_n(first_odd_.data(), columns_, in(1));
  for (int k = 1; 2 * k <= cells_; ++k) {
    const double* low = out(k);
    const double* high = out(cells_ - k);
    double* even = in(2 * k);
    for (int c = 0; c < columns_; ++c)
      even[c] = 0.5 * (low[c] + high[c]);
    if (2 * k + 1 > cells_)
      break;
    const double* previous = in(2 * k - 1);
    double* odd = in(2 * k + 1);
    for (int c = 0; c < lines; ++c) {
      odd[2 * c] = previous[2 * c] + 0.5 * (low[2 * c + 1] - high[2 * c + 1]);
      odd[2 * c + 1] = previous[2 * c + 1] - 0.5 * (low[2 * c] - high[2 * c]);
    }
  }
}

}  // namespace lv::fluid
