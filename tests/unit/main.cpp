#define CATCH_CONFIG_RUNNER
#include "lv/base/parallel.hpp"

#include <catch2/catch.hpp>

int main(int argc, char** argv) {
  const lv::parallel::Session session(&argc, &argv);
  return Catch::Session().run(argc, argv);
}
