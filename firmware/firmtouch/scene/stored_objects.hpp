#pragma once
#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"
#include "firmtouch/scene/object.hpp"
#include "firmtouch/scene/objects_layout.hpp"

namespace firmtouch::scene {

using StoredObjects = core::Span<const ObjectLayout>;

/// Proves a section of type kObjectsSection, except that the meshes exist; `to` refers to its bytes
/// if the verdict is passed, and is empty if not. The element of a verdict is the object.
/// Bounds: at most 45,000 instructions.
core::Verdict open(core::Bytes section, StoredObjects& to);

/// Pre: of a section that open() has proven.
Object object_of(const ObjectLayout& layout);

}  // namespace firmtouch::scene
