#pragma once

#include "platform/files.hpp"
