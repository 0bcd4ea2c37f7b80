#pragma once

#include <stdexcept>
#include <string>

namespace speculum {

// Returns the message of the error that `action` throws.
template <typename Error = std::runtime_error, typename Action>
std::string messageOf(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace speculum
