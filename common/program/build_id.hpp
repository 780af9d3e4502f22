#pragma once
/// What the numbers of a program depend on besides its case: the executable, and the processor's instruction
/// sets by which libraries choose their code.

#include <string>

namespace fsi {

/// Hash the linker left in the executable; the same sources and settings give the same one.
std::string build_id();

/// The widest of the instruction sets that matter, of this processor.
std::string processor_kind();

/// The widest of them that the compiler was allowed to use.
std::string instruction_set();

}  // namespace fsi
