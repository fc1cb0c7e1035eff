#include "lv/base/parallel.hpp"

int main(int argc, char** argv) {
  const lv::parallel::Session session(&argc, &argv);
  return 0;
}
