#include "binding.h"

namespace sphparam::python {

Mapped::Mapped(MappedMesh mesh) : state_(std::make_shared<State>()) {
  state_->mesh = std::move(mesh);
}

Mapped::Mapped(MeshSource source, Topology topology, Provenance provenance, Parameterization made,
               Spent spent, int threads)
    : state_(std::make_shared<State>()) {
  state_->parts = {.file = std::move(source.file),
                   .map = {},
                   .provenance = std::move(provenance),
                   .topology = std::move(topology),
                   .notes = std::move(source.notes),
                   .mapped_here = true,
                   .name = std::move(source.path)};
  state_->made = std::move(made);
  state_->spent = spent;
  state_->threads = threads;
  state_->repairs = std::move(source.repairs);
  state_->handles = std::move(source.handles);
}

const MappedMesh& Mapped::mesh() const {
  if (!state_->made) return *state_->mesh;
  std::call_once(state_->is_made, [this] {
    state_->parts->map = state_->made->map;  // arrays show the one that is there
    state_->mesh.emplace(std::move(*state_->parts), state_->threads);
    state_->parts.reset();
  });
  return *state_->mesh;
}

const SphereMap& Mapped::map() const { return made() ? made()->map : state_->mesh->map(); }

const Certificate& Mapped::certificate() const {
  return made() ? made()->certificate : state_->mesh->certificate();
}

}  // namespace sphparam::python
