"""Maps and charts as files have them, read by nothing that the project has: PLY, GIFTI and OBJ."""

import base64
import struct
import xml.etree.ElementTree
import zlib

FORMATS = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I",
           "float": "f", "double": "d", "int8": "b", "uint8": "B", "int16": "h", "uint16": "H",
           "int32": "i", "uint32": "I", "float32": "f", "float64": "d"}


def ply_header(stream):
    """The elements: [name, count, [(list's count type or None, type, name)…]]; the format; the verdict."""
    elements, kind, verdict = [], "", ""
    for line in iter(lambda: stream.readline().decode("latin1").split(), ["end_header"]):
        if line[0] == "format":
            kind = line[1]
        elif line[:3] == ["comment", "sphparam", "verdict"]:
            verdict = " ".join(line[3:])
        elif line[0] == "element":
            elements.append([line[1], int(line[2]), []])
        elif line[0] == "property":
            listed = line[2] if line[1] == "list" else None
            elements[-1][2].append((listed, line[-2], line[-1]))
    return elements, kind, verdict


class Numbers:
    """The numbers of a PLY, one after the other."""

    def __init__(self, data, kind):
        self.data, self.at = data, 0
        self.order = {"binary_little_endian": "<", "binary_big_endian": ">"}.get(kind)
        self.words = iter(data.split()) if self.order is None else None

    def take(self, kind):
        if self.order is None:
            word = next(self.words)
            return float(word) if FORMATS[kind] in "fd" else int(word)
        value, = struct.unpack_from(self.order + FORMATS[kind], self.data, self.at)
        self.at += struct.calcsize(FORMATS[kind])
        return value

    def row(self, properties):
        found = {}
        for listed, kind, name in properties:
            if listed is None:
                found[name] = self.take(kind)
            else:
                found[name] = [self.take(kind) for _ in range(self.take(listed))]
        return found


def read_ply(path):
    """Rows by element, and what the file says of its map itself."""
    with open(path, "rb") as stream:
        elements, kind, verdict = ply_header(stream)
        numbers = Numbers(stream.read(), kind)
    rows = {name: [numbers.row(properties) for _ in range(count)] for name, count, properties in elements}
    return rows, verdict


def faces_of(ply):
    return [tuple(face.get("vertex_indices", face.get("vertex_index"))) for face in ply["face"]]


def map_of_ply(ply):
    """Rays and triangles, or None where it has no map."""
    if not ply["vertex"] or "sx" not in ply["vertex"][0]:
        return None
    return [(v["sx"], v["sy"], v["sz"]) for v in ply["vertex"]], faces_of(ply)


def chart_of_ply(ply):
    if not ply.get("face") or "texcoord" not in ply["face"][0]:
        return None
    corners = [face["texcoord"] for face in ply["face"]]
    return faces_of(ply), [list(zip(c[::2], c[1::2])) for c in corners], len(ply["vertex"])


def read_gifti(path):
    """Arrays of a surface by their intents: points, triangles."""
    arrays = {}
    for array in xml.etree.ElementTree.parse(path).getroot().iter("DataArray"):
        data = base64.b64decode(array.find("Data").text)
        if array.get("Encoding") == "GZipBase64Binary":
            data = zlib.decompress(data)
        order = "<" if array.get("Endian") == "LittleEndian" else ">"
        kind = {"NIFTI_TYPE_FLOAT32": "f", "NIFTI_TYPE_INT32": "i"}[array.get("DataType")]
        numbers = struct.unpack(f"{order}{len(data) // 4}{kind}", data)
        arrays[array.get("Intent")] = list(zip(numbers[::3], numbers[1::3], numbers[2::3]))
    return arrays["NIFTI_INTENT_POINTSET"], arrays["NIFTI_INTENT_TRIANGLE"]


def read_obj(path):
    """Triangles, (u, v) of their corners or None, and how many vertices there are."""
    uv, faces, corners, count = [], [], [], 0
    for words in map(str.split, open(path, encoding="utf-8")):
        if words[:1] == ["v"]:
            count += 1
        elif words[:1] == ["vt"]:
            uv.append((float(words[1]), float(words[2])))
        elif words[:1] == ["f"]:
            numbers = [(word.split("/") + [""])[:2] for word in words[1:]]
            faces.append(tuple(int(v) - 1 for v, _ in numbers))
            corners.append([uv[int(t) - 1] for _, t in numbers if t])
    return (faces, corners, count) if all(len(c) == 3 for c in corners) else None
