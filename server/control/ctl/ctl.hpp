#pragma once

#include <iosfwd>

namespace pelagos {

/// The program pelagos-ctl. Results go to `out`, errors that say what to do to `err`.
/// @return 0 only on success; 1: the server refused or could not be reached; 2: the command line is wrong
int run_ctl(int argc, const char* const* argv, std::ostream& out, std::ostream& err);

}  // namespace pelagos
