"""Shape models of bodies: ICQ, plate tables and v/f tables counted from 0, each wrong in one way or odd and right."""
import gzip

from corpus import *


def rows(table):
    return "".join(" ".join(map(str, row)) + "\n" for row in table)


def numbered(table, first=1):
    return [(i,) + tuple(row) for i, row in enumerate(table, first)]


# --- Plate tables ------------------------------------------------------------------------------

PLATES = shifted(F4, 1)


def plates(vertices=P4, faces=PLATES, head="4 4\n", between=""):
    return head + rows(vertices) + between + rows(faces)


def naif(vertices=numbered(P4), faces=numbered(PLATES)):
    return plates(vertices, faces, "4\n", "4\n")


def make_plates():
    t, n = plates(), naif()
    ok = lambda name, data: case("plates_ok_%s.tab" % name, data, OK)
    bad = lambda name, data, message="": case("plates_%s.tab" % name, data, UNREADABLE, message)
    ok("plain", t)
    ok("numbered", n)
    ok("not_numbered_between", naif(P4, PLATES))
    ok("counts_on_two_lines", plates(head="4\n4\n"))
    ver = plates(faces=[]) + "".join("3\n %d %d %d\n" % f for f in PLATES)
    case("plates_ok_corners_before.ver", ver, OK)
    case("plates_ok_corners_before.txt", ver, OK)
    bad("corners_before_4", changed(ver, "3\n 1 4 3", "4\n 1 4 3"), ":10: plate has not 3 corners")
    bad("corners_before_missing", changed(ver, "3\n 1 4 3", "1 4 3"), ":10: plate has not 3 corners")
    bad("corners_before_cut", ver[:-7], "ends before plate 4 of 4")
    ok("vertices_numbered_only", plates(numbered(P4)))
    ok("counted_from_zero", plates(faces=F4))
    ok("numbered_from_zero", naif(numbered(P4, 0), numbered(F4, 0)))
    ok("crlf", t.replace("\n", "\r\n"))
    ok("cr", n.replace("\n", "\r"))
    ok("fixed_columns", "".join(line.rjust(44) + "\r\n" for line in t.splitlines()))
    ok("comments_and_blank_lines", "# a\n\n" + t.replace("\n", " # b\n\n"))
    ok("exponents_of_fortran", t.replace("\n1 1 1\n", "\n0.1D+01 1.0d0 10D-1\n"))
    ok("data_after_the_plates", t + "1 2 3\n")
    ok("unused_vertex", plates([(9, 9, 9)] + P4, shifted(F4, 2), "5 4\n"))
    case("plates_ok_named.plt", t, OK)
    case("plates_ok_packed.tab.gz", gzip.compress(n.encode(), mtime=0), OK)
    case("plates_ok_of_no_name.txt", n, OK)
    case("plates_ok_named.obj", t, OK)
    case("plates_ok_obj_named.tab", obj(P4, F4), OK)
    bad("of_words", "hello\n", ":1: expected a whole number, found 'hello'")
    bad("of_comments", "# a\n", "holds no number of vertices")
    bad("gnuplot", "set terminal png\nplot 'a'\n", "expected a whole number, found 'set'")
    bad("counts_alone", "4 4\n", "do not fit the 0 bytes")
    bad("count_of_vertices_alone", "4\n", "do not fit the 0 bytes")
    for cut in (20, 40, 52, len(n) - 9):
        bad("cut_%d" % cut, n[:cut])
    bad("no_plate_count", "4\n" + rows(numbered(P4)), "ends before the number of plates")
    bad("last_plate_missing", plates(faces=PLATES[:3]) + "# 4 of 4\n", "ends before plate 4 of 4")
    for count in ("-4", "5", "3", "268435457", "99999999999999999999", "4.0", "four"):
        tag = count.replace("-", "minus").replace(".", "_")
        bad("vertices_" + tag, plates(head=count + " 4\n"))
        bad("plates_" + tag, plates(head="4 " + count + "\n") if count != "3" else plates(head="4 4 3\n"))
    bad("index_beyond", plates(faces=PLATES[:3] + [(2, 3, 5)]), ":9: plate names vertex 5 of 4")
    bad("index_negative", plates(faces=PLATES[:3] + [(2, 3, -4)]), ":9: plate names vertex -4 of 4")
    bad("index_zero", plates(faces=[(0, 3, 2)] + PLATES[1:]), ":6: plate names vertex 0, but the largest is 4 of 4")
    bad("index_zero_last_unused", plates([(9, 9, 9)] + P4, F4, "5 4\n"), ":7: plate names vertex 0, but the largest is 3 of 5")
    bad("index_twice", plates(faces=[(1, 3, 3)] + PLATES[1:]), ":6: face names a vertex twice")
    bad("index_real", plates(faces=[(1.5, 3, 2)] + PLATES[1:]), "expected a whole number")
    bad("quad", plates(faces=[(1, 3, 2, 4)] + PLATES[1:]), ":7: expected plate 2, found 1")
    bad("five_numbers", plates(faces=[(1, 1, 3, 2, 4)] + PLATES[1:]), ":6: plate has more than 4 numbers")
    bad("numbers_of_vertices_wrong", naif(numbered(P4, 2)), ":2: expected the number of the first vertex, 1 or 0, found 2")
    bad("numbers_of_vertices_jump", naif([(1, 1, 1, 1), (3, -1, -1, 1)] + numbered(P4)[2:]), ":3: expected vertex 2, found 3")
    bad("numbers_of_plates_jump", naif(faces=numbered(PLATES)[:3] + [(5, 2, 3, 4)]), ":10: expected plate 4, found 5")
    bad("albedo", plates([p + (0.5,) for p in P4]), ":3: expected vertex 2, found -1 (of 4 numbers a line the first counts)")
    bad("two_coordinates", changed(t, "\n1 1 1\n", "\n1 1\n"), ":2: expected a number, found the end of the line")
    bad("four_coordinates_once", changed(t, "-1 -1 1\n", "-1 -1 1 1\n"), ":3: unexpected '1' at the end")
    for word in ("nan", "inf", "1e999", "1D999", "1,0", "0x1", "D", "1D"):
        bad("number_" + word.replace(",", "_"), changed(t, "\n1 1 1\n", "\n1 1 %s\n" % word), ":2: expected a number")
    bad("nul", changed(t, "1 1 1", "1 1 \0"), "NUL byte")
    case("plates_open.tab", plates(faces=PLATES[:3], head="4 3\n"), NO_SPHERE, "boundary edge")
    case("plates_none.tab", plates(faces=[], head="4 0\n"), NO_SPHERE, "no faces")


# --- ICQ ---------------------------------------------------------------------------------------

def icq_points(q, place=lambda x, y, z: (x, y, z)):
    """The grids on a cube of edge 2, in the order of the format."""
    faces = (lambda i, j: (q - i, j, q), lambda i, j: (q - i, q, q - j), lambda i, j: (q, i, q - j),
             lambda i, j: (i, 0, q - j), lambda i, j: (0, q - i, q - j), lambda i, j: (q - i, q - j, 0))
    return [place(*(2 * c / q - 1 for c in face(i, j))) for face in faces for j in range(q + 1) for i in range(q + 1)]


def icq(q=2, points=None, more=()):
    return "%12d\n" % q + rows(tuple(p) + tuple(more) for p in points or icq_points(q))


def make_icq():
    t = icq()
    ok = lambda name, data: case("icq_ok_%s.icq" % name, data, OK)
    bad = lambda name, data, message="": case("icq_%s.icq" % name, data, UNREADABLE, message)
    ok("plain", t)
    ok("of_six_quads", icq(1))
    ok("finer", icq(5))
    ok("crlf", t.replace("\n", "\r\n"))
    ok("cr", t.replace("\n", "\r"))
    ok("albedo", icq(more=(0.5,)))
    ok("albedo_that_differs", changed(icq(more=(0.5,)), "0.5", "0.6"))
    ok("exponents_of_fortran", t.replace(".0", ".00000D+00"))
    ok("comments", "# a\n" + t.replace("\n", " # b\n\n"))
    ok("minus_zero", t.replace(" 0.0 ", " -0.0 ", 3))
    ok("data_after_the_vectors", t + "1 2 3\n")
    case("icq_ok_named.tab", t, OK)
    case("icq_ok_named.TXT", t, OK)
    case("icq_ok_packed.icq.gz", gzip.compress(t.encode(), mtime=0), OK)
    bad("of_words", "hello\n", ":1: expected a whole number, found 'hello'")
    bad("of_comments", "# a\n", "holds no q")
    for q in ("0", "-1", "16385", "99999999999999999999", "2.0", "1 2"):
        bad("q_" + q.replace("-", "minus").replace(".", "_").replace(" ", "_"), changed(t, "2\n", q + "\n"))
    bad("q_too_large", changed(t, "2\n", "16384\n"), "over the limit")
    bad("q_beyond_the_file", changed(t, "2\n", "50\n"), "q = 50 makes 15606 vectors, which do not fit")
    bad("q_3", changed(t, "2\n", "3\n"), "ends before vector 55 of 96")
    bad("cut", t[:t.rindex("1.0 ")], ":55: expected a number, found '-'")
    bad("last_vector_missing", t[:t.rindex("\n", 0, -1) + 1], "ends before vector 54 of 54")
    bad("two_coordinates", changed(t, "1.0 -1.0 1.0\n", "1.0 -1.0\n"), ":2: expected a number")
    bad("five_numbers", icq(more=(1, 2)), ":2: unexpected")
    bad("albedo_once", changed(t, "1.0 -1.0 1.0\n", "1.0 -1.0 1.0 7\n"), ":3: expected a number, found the end")
    for word in ("nan", "inf", "1D999", "1,0", "D0"):
        bad("number_" + word.replace(",", "_"), changed(t, "1.0 -1.0 1.0\n", "1.0 -1.0 %s\n" % word), ":2: expected a number")
    bad("albedo_nan", icq(more=("nan",)), ":2: expected a number")
    bad("nul", changed(t, "1.0 -1.0 1.0", "1.0 -1.0 \0"), "NUL byte")
    case("icq_seam_open.icq", changed(t, "1.0 -1.0 1.0\n", "1.5 -1.5 1.5\n"), NO_SPHERE, "boundary")
    case("icq_faces_in_another_order.icq", icq(points=icq_points(2)[9:] + icq_points(2)[:9]), OK)
    case("icq_all_in_one_point.icq", icq(points=[(1, 2, 3)] * 54), NO_SPHERE, "no area")


# --- v/f tables --------------------------------------------------------------------------------

def make_tables():
    t = "".join("v %s %s %s\n" % p for p in P4) + "".join("f %d %d %d\n" % f for f in F4)
    bad = lambda name, data, message: case("table_%s.obj" % name, data, UNREADABLE, message)
    case("table_ok_from_zero.obj", t, OK)
    case("table_ok_from_zero.tab", t, OK)
    case("table_ok_faces_first.obj", "".join(reversed(t.splitlines(True))), OK)
    bad("zero_and_last_unused", "v 9 9 9\n" + t, ":6: vertex index 0: indices start at 1")
    bad("zero_and_count", changed(t, "f 0 3 2", "f 0 4 2"), ":5: vertex index 0: indices start at 1")
    bad("zero_and_beyond", changed(t, "f 0 3 2", "f 0 5 2"), ":7: face names vertex 5 of 4")
    bad("zero_and_relative", changed(t, "f 0 3 2", "f 0 -1 2"), ":5: vertex index 0")
    bad("zero_and_texture", changed("vt 0 0\n" + t, "f 0 3 2", "f 0/1 3/1 2/1"), ":6: vertex index 0")
    bad("zero_and_normal", changed("vn 0 0 1\n" + t, "f 0 3 2", "f 0//1 3//1 2//1"), ":6: vertex index 0")
    bad("zero_twice", changed(t, "f 0 3 2", "f 0 0 2"), ":7: face names a vertex twice")


def make_all():
    make_plates()
    make_icq()
    make_tables()
