#include "mesh/defect_places.h"

#include <algorithm>

namespace sphparam {

namespace {

long ids_of(RepairPlace place) { return place == RepairPlace::Edges ? 2 : 1; }

const char* noun_of(RepairPlace place) {
  switch (place) {
    case RepairPlace::Vertices:
      return "vertices";
    case RepairPlace::Edges:
      return "between vertices";
    case RepairPlace::Faces:
      break;
  }
  return "faces";
}

}  // namespace

RepairPlace place_of(DefectKind kind) {
  switch (kind) {
    case DefectKind::IndexOutOfRange:
    case DefectKind::RepeatedVertex:
    case DefectKind::DuplicateFace:
    case DefectKind::ZeroAreaFace:
      return RepairPlace::Faces;
    case DefectKind::BoundaryEdge:
    case DefectKind::NonManifoldEdge:
    case DefectKind::InconsistentOrientation:
      return RepairPlace::Edges;
    case DefectKind::NonFinitePosition:
    case DefectKind::NonManifoldVertex:
    case DefectKind::UnusedVertex:
    case DefectKind::CoincidentVertices:
    case DefectKind::Empty:
    case DefectKind::SeveralComponents:
    case DefectKind::WrongGenus:
    case DefectKind::InsideOut:
      break;
  }
  return RepairPlace::Vertices;
}

std::string place_list(const PlaceWords& words, RepairPlace place, const std::vector<int>& elements,
                       long count) {
  const long ids = ids_of(place);
  std::string list;
  long unnamed = 0;
  for (auto at = elements.begin(); at != elements.end(); at += ids) {
    const int first = *at, second = *(at + ids - 1);
    if (first < 0 || second < 0) {
      ++unnamed;
      continue;
    }
    list += (list.empty() ? ": " + std::string(words.noun) + " " : ", ") + std::to_string(first);
    if (ids == 2) list.append("-").append(std::to_string(second));
  }
  if (unnamed > 0)
    list += (list.empty() ? ": " : " and ") + std::to_string(unnamed) + " " + words.unnamed;
  return list + (std::ssize(elements) / ids < count ? ", …" : "");
}

std::string place_list(RepairPlace place, const std::vector<int>& elements, long count) {
  if (elements.empty()) return {};
  return place_list({noun_of(place), "that the file does not have"}, place, elements, count);
}

MeshDefect renumbered(MeshDefect defect, const std::function<long(Vertex)>& vertex,
                      const std::function<long(Face)>& face) {
  const RepairPlace place = place_of(defect.kind);
  const std::string old_list = place_list(place, defect.elements, defect.count);
  const long ids = ids_of(place);
  std::vector<int> numbers, named;
  for (const int id : defect.elements)
    numbers.push_back(static_cast<int>(place == RepairPlace::Faces ? face(id) : vertex(id)));
  // Triangles of one polygon are one place.
  const auto are_one = [place](int a, int b) {
    return place == RepairPlace::Faces && a == b && a >= 0;
  };
  numbers.erase(std::unique(numbers.begin(), numbers.end(), are_one), numbers.end());
  const long places = defect.count - std::ssize(defect.elements) / ids + std::ssize(numbers) / ids;
  for (auto first = numbers.begin(); first != numbers.end(); first += ids) {
    if (std::all_of(first, first + ids, [](int id) { return id >= 0; }))
      named.insert(named.end(), first, first + ids);
  }
  if (defect.message.ends_with(old_list)) {
    defect.message.resize(defect.message.size() - old_list.size());
    defect.message += place_list(place, numbers, places);
  }
  defect.elements = std::move(named);
  return defect;
}

}  // namespace sphparam
