#include <iostream>

#include "ctl.hpp"

int main(int argc, char** argv) { return pelagos::run_ctl(argc, argv, std::cout, std::cerr); }
