#pragma once

#include "platform/files.hpp"
#include "platform/folders.hpp"
#include "platform/machine.hpp"
#include "platform/process.hpp"
