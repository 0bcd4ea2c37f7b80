#pragma once

#include <functional>
#include <string>

#include "scene/scene.hpp"

namespace speculum::panels {

// Called after each widget with its name, such as "edit.orbit.speed".
using RecordWidget = std::function<void(const std::string& name)>;

// Draw rows for the fields of a node, from their descriptions in scene/scene_fields.hpp. `polygon` draws those of a
// mirror's vertices. Return true if the user changed a field.
bool fieldRows(Object& object, const RecordWidget& record);
bool fieldRows(PointLight& light, const RecordWidget& record);
bool fieldRows(Mirror& mirror, const RecordWidget& record, const std::function<bool()>& polygon);

}  // namespace speculum::panels
