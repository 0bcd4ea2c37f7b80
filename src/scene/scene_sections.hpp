#pragma once

#include "scene/scene.hpp"
#include "scene/table_reader.hpp"

namespace speculum {

// The parts of a scene file, each from its table; all throw InputError. Object::mesh is left to the caller.
Environment readEnvironment(const TableReader& file);
CameraSpec readCamera(const TableReader& file);
std::vector<SettingEntry> readSettings(const TableReader& file);
Object readObject(const TableReader& table);
PointLight readLight(const TableReader& table);
Mirror readMirror(const TableReader& table);
Bookmark readBookmark(const TableReader& table, const CameraSpec& camera);

std::span<const std::string_view> objectKeys();
std::span<const std::string_view> lightKeys();
std::span<const std::string_view> mirrorKeys();
std::span<const std::string_view> bookmarkKeys();

}  // namespace speculum
