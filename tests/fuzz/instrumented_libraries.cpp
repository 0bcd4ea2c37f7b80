// Builds this parser with sanitizers and coverage, which the distribution's build lacks.
#define TOML_IMPLEMENTATION
#include <toml++/toml.h>
