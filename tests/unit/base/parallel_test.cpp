#include "lv/base/parallel.hpp"

#include <catch2/catch.hpp>

using namespace lv;

TEST_CASE("shares follow one another, cover all and differ by one at most", "[unit][base]") {
  for (const int n : {0, 1, 7, 128}) {
    for (const int ranks : {1, 2, 3, 8}) {
      int next = 0;
      for (int rank = 0; rank < ranks; ++rank) {
        const auto share = parallel::share(n, rank, ranks);
        CHECK(share.begin == next);
        CHECK(share.size() >= n / ranks);
        CHECK(share.size() <= (n + ranks - 1) / ranks);
        next = share.end;
      }
      CHECK(next == n);
    }
  }
}

TEST_CASE("what is gathered in rank order scatters back to where it came from", "[unit][base]") {
  const std::vector<double> piece(3 + parallel::rank(), 1.5 + parallel::rank());
  const std::vector<double> all = parallel::gather(piece);
  if (parallel::is_root())
    CHECK(static_cast<int>(all.size()) ==
          parallel::size() * 3 + parallel::size() * (parallel::size() - 1) / 2);
  CHECK(parallel::scatter(all, piece.size()) == piece);
}
