#include "mesh/repair/paired_faces.h"

// Turning rewrites the two faces in place, splitting and collapsing rewrite what is there and add
// or drop two faces. Corners keep the attributes of the corner that was at the same vertex of the
// same face; a middle vertex's corners take the mean of the side's two ends.

namespace sphparam {

PairedFaces::PairedFaces(RepairState& state, std::vector<Halfedge> twin)
    : state_(state),
      twin_(std::move(twin)),
      alive_(state.faces.size(), 1),
      alive_count_(state.face_count()) {
  uses_.reserve(2 * state.faces.size());
  for (Halfedge h = 0; h < static_cast<Halfedge>(twin_.size()); ++h) {
    if (twin_[h] < h) use(origin(h), target(h));  // each edge once; boundary ones have twin −1
  }
}

void PairedFaces::release(Vertex a, Vertex b) {
  const auto found = uses_.find(key(a, b));
  if (--found->second == 0) uses_.erase(found);
}

void PairedFaces::join(Halfedge g, Halfedge h) {
  if (g >= 0) twin_[g] = h;
  if (h >= 0) twin_[h] = g;
}

bool PairedFaces::can_turn(Halfedge h) const {
  const Halfedge t = twin(h);
  if (t < 0 || origin(t) != target(h)) return false;
  return apex(h) != apex(t) && !has_edge(apex(h), apex(t));
}

// (a, b, c) and (b, a, d) become (a, d, c) and (d, b, c).
void PairedFaces::turn(Halfedge h) {
  const Halfedge t = twin(h);
  const Face f = h / 3, g = t / 3;
  const Halfedge outer[] = {twin(next(t)), twin(previous(h)), twin(previous(t)), twin(next(h))};
  const Vertex a = origin(h), b = target(h), c = apex(h), d = apex(t);
  const int like_a = state_.corner_like(h), like_b = state_.corner_like(t),
            like_c = state_.corner_like(previous(h)), like_d = state_.corner_like(previous(t));
  state_.faces[f] = {a, d, c};
  state_.corner_origin[f] = {like_a, like_d, like_c};
  state_.faces[g] = {d, b, c};
  state_.corner_origin[g] = {like_d, like_b, like_c};
  join(outer[0], 3 * f);
  join(outer[1], 3 * f + 2);
  join(outer[2], 3 * g);
  join(outer[3], 3 * g + 1);
  join(3 * f + 1, 3 * g + 2);
  release(a, b);
  use(c, d);
}

// (x, y, z) with h = x → y becomes (x, m, z) and (m, y, z). Returns m → y.
Halfedge PairedFaces::split_side(Halfedge h, Vertex middle) {
  const Face f = h / 3, added = state_.face_count();
  const Halfedge along = next(h), beyond = previous(h);
  const Vertex y = origin(along), z = origin(beyond);
  const int like_y = state_.corner_like(along);
  const int like_middle = state_.blend(state_.corner_like(h), like_y, 0.5);
  state_.add_face({middle, y, z}, {like_middle, like_y, state_.corner_like(beyond)});
  state_.face_origin[added] = state_.face_origin[f];
  state_.fillers[added] = state_.fillers[f];
  state_.faces[f][along % 3] = middle;
  state_.corner_origin[f][along % 3] = like_middle;
  twin_.resize(twin_.size() + 3, -1);
  alive_.push_back(1);
  ++alive_count_;
  join(twin(along), 3 * added + 1);
  join(along, 3 * added + 2);
  use(middle, z);
  return 3 * added;
}

void PairedFaces::split(Halfedge h) {
  const Halfedge t = twin(h);
  const Vertex a = origin(h), b = target(h);
  const bool runs_alike = t >= 0 && origin(t) == a;
  const Vertex middle = state_.create_mean({a, b});
  const Halfedge far = split_side(h, middle);
  release(a, b);
  use(a, middle);
  use(middle, b);
  if (t < 0) return;
  const Halfedge far_twin = split_side(t, middle);
  join(h, runs_alike ? t : far_twin);
  join(far, runs_alike ? far_twin : t);
}

template <class Visit>
void PairedFaces::for_each_outgoing(Halfedge h, Visit&& visit) const {
  Halfedge at = h;
  do {
    const Halfedge following = twin(previous(at));
    visit(at);
    at = following;
  } while (at != h);
}

// Walks about both ends at once until one is back where it began.
Halfedge PairedFaces::from_smaller_end(Halfedge h) const {
  const Halfedge t = twin(h);
  Halfedge g = h, s = t;
  for (;;) {
    g = twin(previous(g));
    if (g == h) return h;
    s = twin(previous(s));
    if (s == t) return t;
  }
}

bool PairedFaces::can_collapse(Halfedge h) const {
  if (alive_count_ <= 4) return false;
  h = from_smaller_end(h);
  const Vertex other = target(h);
  int common = 0;
  for_each_outgoing(h, [&](Halfedge at) {
    const Vertex neighbour = target(at);
    common += neighbour != other && has_edge(neighbour, other);
  });
  return common == 2;
}

Vertex PairedFaces::collapse(Halfedge h) {
  h = from_smaller_end(h);
  const Halfedge t = twin(h);
  const Vertex removed = origin(h), kept = target(h), c = apex(h), d = apex(t);
  std::vector<Halfedge> star;
  for_each_outgoing(h, [&](Halfedge at) { star.push_back(at); });
  for (const Halfedge at : star) {
    const Vertex neighbour = target(at);
    release(removed, neighbour);
    if (neighbour != kept && neighbour != c && neighbour != d) use(kept, neighbour);
  }
  for (const Halfedge at : star) state_.faces[at / 3][at % 3] = kept;
  const Halfedge outer[] = {twin(next(h)), twin(previous(h)), twin(next(t)), twin(previous(t))};
  join(outer[0], outer[1]);
  join(outer[2], outer[3]);
  alive_[h / 3] = alive_[t / 3] = 0;
  alive_count_ -= 2;
  return kept;
}

void PairedFaces::finish() { state_.keep_faces(alive_); }

}  // namespace sphparam
