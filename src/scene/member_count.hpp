#pragma once

#include <cstddef>

namespace speculum {

// Stands for an initializer of any type; never converted while the program runs.
struct AnyInitializer {
  template <typename T>
  operator T() const;
};

// Number of members of an aggregate: the most initializers that it takes. A description that lists the members of a
// type compares their number with it in a static_assert, so that a missing member does not compile.
template <typename T, typename... Initializers>
consteval size_t memberCount(Initializers... initializers) {
  if constexpr (requires { T{initializers..., AnyInitializer{}}; }) {
    return memberCount<T>(initializers..., AnyInitializer{});
  } else {
    return sizeof...(Initializers);
  }
}

}  // namespace speculum
