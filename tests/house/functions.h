// The functions of a source file as its text tells them: where they begin, how many lines they
// take, how many parameters they have, and what they return. Reads our own style of C++, not all of it.
#pragma once

#include "tests/house/source_tree.h"

namespace meninas {

/// A definition, or a declaration of one that is defined elsewhere.
struct Function {
  std::string name;
  std::string returned;  ///< its return type with what stands before it; empty of constructors
  std::size_t line = 0;  ///< of its first line, from 1
  std::size_t lines = 0; ///< from there to its closing brace, or to the semicolon
  std::size_t parameters = 0;
  bool is_member = false;
};

/// Functions of namespaces and types, in the order of the file; lambdas belong to those they are in.
std::vector<Function> functions_of(const SourceFile& file);

/// Definitions of more than 60 lines, and functions of more than 6 parameters, outside tests and
/// benchmarks. One line for each breach, `PATH:LINE: WHAT`.
std::vector<std::string> function_breaches(const std::vector<SourceFile>& tree);

} // namespace meninas
