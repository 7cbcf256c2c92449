"""Files of numbers a vertex, for a surface of four: curv, annot, label, MGH, GIFTI without a surface."""
import gzip
import struct

from corpus import OK, UNREADABLE, case

VALUES = [1.5, -2, 0, 4]


def ints(*numbers):
    return struct.pack(">%di" % len(numbers), *numbers)


def curv(count=4, triangles=4, each=1, values=VALUES, magic=b"\xff\xff\xff"):
    return magic + ints(count, triangles, each) + struct.pack(">%df" % len(values), *values)


def text(words):
    return ints(len(words) + 1) + words + b"\0"


def label(key, name, colour):
    return ints(key) + text(name) + ints(*colour)


LABELS = label(0, b"unknown", (0, 0, 0, 0)) + label(1, b"red", (255, 0, 0, 0))


def annot(count=4, pairs=(0, 0, 1, 255, 2, 255, 3, 0), tag=1, version=-2, largest=2, table=b"table.txt", lines=2, labels=LABELS):
    return ints(count) + ints(*pairs) + ints(tag, version, largest) + text(table) + ints(lines) + labels


def old_annot():
    lines = text(b"unknown") + ints(0, 0, 0, 0) + text(b"red") + ints(255, 0, 0, 0)
    return ints(4, 0, 0, 1, 255, 2, 255, 3, 0, 1, 2) + text(b"table.txt") + lines


def mgh(sizes=(4, 1, 1, 1), kind=3, version=1, data=struct.pack(">4f", *VALUES)):
    return (ints(version, *sizes, kind, 0) + bytes(256)) + data


def array(intent, kind, data, dimensions='Dimensionality="1" Dim0="4"', more=""):
    return ('<DataArray Intent="NIFTI_INTENT_%s" DataType="NIFTI_TYPE_%s" ArrayIndexingOrder="RowMajorOrder" %s '
            'Encoding="ASCII" Endian="LittleEndian" ExternalFileName="" ExternalFileOffset="">%s<Data>%s</Data></DataArray>'
            % (intent, kind, dimensions, more, data))


def gifti(*arrays, table=""):
    return '<?xml version="1.0"?><GIFTI Version="1.0" NumberOfDataArrays="%d">%s%s</GIFTI>' % (len(arrays), table, "".join(arrays))


TABLE = '<LabelTable><Label Key="1" Red="1" Green="0" Blue="0" Alpha="1">red</Label></LabelTable>'
LABEL_FILE = "#!ascii label  , from nobody\n2\n0  1 1 1 0\n3  1 -1 -1 0\n"


def make_binary(name, ending, good, number_at):
    """Cuts, and a number that is far from good, where one is."""
    for size in sorted({5, 10, 20, len(good) // 2, len(good) - 1}):
        case("values_%s_cut_%d%s" % (name, size, ending), good[:size], UNREADABLE)
    for number in (-1, 0, 5, 2**28, 2**31 - 1):
        changed = good[:number_at] + ints(number) + good[number_at + 4:]
        case("values_%s_count_%s%s" % (name, str(number).replace("-", "minus"), ending), changed, UNREADABLE)


def make_freesurfer_values():
    bad = lambda name, data, message="": case("values_" + name, data, UNREADABLE, message)
    ok = lambda name, data: case("values_ok_" + name, data, OK)
    ok("plain.curv", curv())
    ok("nan.curv", curv(values=[1, float("nan"), 2, 3]))
    ok("infinite.curv", curv(values=[1, float("inf"), 2, 3]))
    ok("more.curv", curv() + b"more")
    ok("packed.curv", gzip.compress(curv(), mtime=0))
    bad("three.curv", curv(each=3), "3 values a vertex")
    bad("of_five.curv", curv(count=5, values=VALUES + [1]), "the surface has 4")
    make_binary("curv", ".curv", curv(), 3)
    ok("plain.annot", annot())
    ok("old.annot", old_annot())
    ok("colour_unknown.annot", annot(pairs=(0, 7, 1, 255, 2, -1, 3, 0)))
    bad("no_table.annot", annot()[:36], "no colour table")
    bad("tag.annot", annot(tag=7), "no colour table")
    bad("version.annot", annot(version=-3), "version 3")
    bad("version_least.annot", annot(version=-2**31), "version 2147483648")
    bad("vertex_beyond.annot", annot(pairs=(0, 0, 4, 0, 2, 0, 3, 0)), "names vertex 4 of 4")
    bad("vertex_twice.annot", annot(pairs=(0, 0, 1, 0, 1, 0, 3, 0)), "names vertex 1 twice")
    bad("lines.annot", annot(lines=2**31 - 1))
    bad("lines_negative.annot", annot(lines=-5), "-5 lines")
    bad("key_twice.annot", annot(labels=label(1, b"a", (1, 2, 3, 0)) * 2), "two labels of number 1")
    bad("key_huge.annot", annot(labels=label(2**31 - 1, b"a", (1, 2, 3, 0)) + LABELS), "label of number")
    bad("colour_300.annot", annot(labels=label(1, b"a", (300, 2, 3, 0)) + LABELS), "colour of 300")
    bad("text_negative.annot", annot(labels=ints(0, -1)), "a text of -1 bytes")
    bad("text_huge.annot", annot(labels=ints(0, 2**31 - 1)), "a text of")
    make_binary("annot", ".annot", annot(), 0)
    ok("plain.label", LABEL_FILE)
    ok("empty.label", "#!ascii label\n0\n")
    ok("lines_after.label", LABEL_FILE + "more\n")
    bad("count.label", LABEL_FILE.replace("\n2\n", "\n5\n"), "5 vertices in the label")
    bad("count_negative.label", LABEL_FILE.replace("\n2\n", "\n-1\n"))
    bad("short.label", LABEL_FILE.replace("\n2\n", "\n3\n"), "ends after 2 of 3")
    bad("vertex_beyond.label", LABEL_FILE.replace("\n3 ", "\n4 "), "names vertex 4 of 4")
    bad("word.label", LABEL_FILE.replace("\n3 ", "\nx "))
    bad("nul.label", LABEL_FILE + "\0")


def make_mgh():
    bad = lambda name, data, message="": case("values_" + name, data, UNREADABLE, message)
    ok = lambda name, data: case("values_ok_" + name, data, OK)
    ok("plain.mgh", mgh())
    ok("packed.mgz", gzip.compress(mgh(), mtime=0))
    ok("bytes.mgh", mgh(kind=0, data=bytes(4)))
    ok("series.mgh", mgh(sizes=(4, 1, 1, 2), data=bytes(32) + struct.pack(">f", 720)))
    ok("other_axis.mgh", mgh(sizes=(1, 1, 4, 1)))
    bad("volume.mgh", mgh(sizes=(2, 2, 1, 1)), "a volume")
    bad("type.mgh", mgh(kind=7), "numbers of type 7")
    bad("version.mgh", mgh(version=2), "")
    bad("frames.mgh", mgh(sizes=(4, 1, 1, 2**31 - 1)), "frames")
    bad("size_negative.mgh", mgh(sizes=(4, -1, 1, 1)), "a size of -1")
    bad("packed_cut.mgz", gzip.compress(mgh(), mtime=0)[:40])
    make_binary("mgh", ".mgh", mgh(), 4)


def make_gifti_values():
    bad = lambda name, data, message="": case("values_" + name, data, UNREADABLE, message)
    ok = lambda name, data: case("values_ok_" + name, data, OK)
    shape, keys = array("SHAPE", "FLOAT32", "1 2 3 4"), array("LABEL", "INT32", "0 1 1 0")
    ok("plain.shape.gii", gifti(shape))
    ok("missing.shape.gii", gifti(array("SHAPE", "FLOAT32", "1 nan 3 4")))
    ok("columns.func.gii", gifti(array("TIME_SERIES", "FLOAT32", "1 2 3 4 5 6 7 8", 'Dimensionality="2" Dim0="4" Dim1="2"')))
    ok("plain.label.gii", gifti(keys, table=TABLE))
    ok("no_table.label.gii", gifti(keys))
    bad("none.shape.gii", gifti(), "no arrays")
    bad("mixed.label.gii", gifti(shape, keys), "labels beside")
    bad("fraction.label.gii", gifti(array("LABEL", "FLOAT32", "0 1.5 1 0")), "no whole numbers")
    bad("sparse.shape.gii", gifti(array("NODE_INDEX", "INT32", "0 1 2 3"), shape), "sparse")
    bad("rows.shape.gii", gifti(shape, array("SHAPE", "FLOAT32", "1 2", 'Dimensionality="1" Dim0="2"')), "another number of rows")
    bad("of_three.shape.gii", gifti(array("SHAPE", "FLOAT32", "1 2 3", 'Dimensionality="1" Dim0="3"')), "the surface has 4")
    bad("no_rows.shape.gii", gifti(array("SHAPE", "FLOAT32", "", 'Dimensionality="1" Dim0="0"')), "no vertex")
    bad("no_columns.shape.gii", gifti(array("SHAPE", "FLOAT32", "", 'Dimensionality="2" Dim0="4" Dim1="0"')), "no numbers")
    bad("surface.surf.gii", gifti(array("POINTSET", "FLOAT32", "1 1 1", 'Dimensionality="2" Dim0="1" Dim1="3"')), "a surface")
    bad("fewer.shape.gii", gifti(array("SHAPE", "FLOAT32", "1 2 3")), "its data cannot hold")
    bad("unknown.values", "nothing that is known", "no file of values")


def make_all():
    make_freesurfer_values()
    make_mgh()
    make_gifti_values()
