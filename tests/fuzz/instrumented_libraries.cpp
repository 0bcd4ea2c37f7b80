// The distribution's build of this parser knows no sanitizer and no coverage; here it stands in for it.
#define TOML_IMPLEMENTATION
#include <toml++/toml.h>
