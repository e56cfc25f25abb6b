#pragma once
// Memory given back.

namespace delmesh {

/// Empties a vector and gives its memory back. To assign {} keeps the memory.
template <class Vector>
void let_go(Vector& vector) {
    Vector().swap(vector);
}

}  // namespace delmesh
