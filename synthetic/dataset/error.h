#pragma once

#include <stdexcept>
#include <string>

namespace pelvireg
{
/// Bad input: a file, a case value, a command-line word. The message is one sentence that says what, where, got,
/// allowed and remedy. The program prints it and ends with exit status 2; nothing half-written stays.
class InputError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// The reference solver or the generator of the anatomy could not finish: no file is written, exit status 1.
class ComputationError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};
} // namespace pelvireg
