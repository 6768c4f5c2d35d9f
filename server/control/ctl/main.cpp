#include <iostream>

#include "ctl.hpp"

int main(int argc, char** argv) {
  const int status = pelagos::run_ctl(argc, argv, std::cout, std::cerr);
  std::cout.flush();
  if (std::cout) return status;
  std::cerr << "pelagos-ctl: cannot write to standard output: check the space left\n";
  return status == 0 ? 1 : status;
}
