#pragma once

#include "scene/scene_fields.hpp"
#include "scene/table_reader.hpp"

namespace speculum {

// Each function reads a part of a scene file from its table. Throws InputError. Object::mesh is left to the caller.
Environment readEnvironment(const TableReader& file);
CameraSpec readCamera(const TableReader& file);
std::vector<SettingEntry> readSettings(const TableReader& file, std::string_view key = "settings");
Object readObject(const TableReader& table);
PointLight readLight(const TableReader& table);
Mirror readMirror(const TableReader& table);
Bookmark readBookmark(const TableReader& table, const CameraSpec& camera);

// Returns the values of a key of `table` as --set takes them; a plain value counts as a list of one. Throws InputError.
std::vector<std::string> settingTexts(const TableReader& table, std::string_view key, const toml::node& node);

// Returns the keys of the table that a node is read from.
template <Described Node>
std::span<const std::string_view> keysOf() {
  static const std::array<std::string_view, fieldCount<Node>> keys =
      std::apply([](const auto&... field) { return std::array{field.key...}; }, fieldsOf<Node>);
  return keys;
}

}  // namespace speculum
