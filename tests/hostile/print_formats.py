"""3MF, each wrong in one way or odd and right."""
import io
import zipfile

from corpus import *


def packed(files, method=zipfile.ZIP_STORED):
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w") as archive:
        for name, text in files:
            archive.writestr(zipfile.ZipInfo(name), text, method)
    return data.getvalue()


def model(resources, build, root="<model unit='millimeter' xmlns='m'>"):
    return "<?xml version='1.0'?>%s<resources>%s</resources><build>%s</build></model>" % (root, resources, build)


def mesh(points=P4, faces=F4):
    return ("<mesh><vertices>%s</vertices><triangles>%s</triangles></mesh>" %
            ("".join("<vertex x='%s' y='%s' z='%s'/>" % p for p in points),
             "".join("<triangle v1='%d' v2='%d' v3='%d'/>" % f for f in faces)))


def make_three_mf():
    one = "<object id='1'>%s</object>" % mesh()
    item = "<item objectid='1'/>"
    plain = model(one, item)
    in_file = lambda text: packed([("3D/3dmodel.model", text)])
    ok = lambda name, data: case("three_mf_ok_%s.3mf" % name, data, OK)
    bad = lambda name, data, message: case("three_mf_%s.3mf" % name, data, UNREADABLE, message)
    whole = in_file(plain)
    ok("plain", whole)
    ok("deflated", packed([("3D/3dmodel.model", plain)], zipfile.ZIP_DEFLATED))
    ok("prefixes", in_file(plain.replace("<", "<c:").replace("<c:/", "</c:").replace("<c:?", "<?")))
    ok("mirrored", in_file(model(one, "<item objectid='1' transform='-1 0 0 0 1 0 0 0 1 0 0 0'/>")))
    ok("extensions", in_file(model(one + "<b:lattice><b:vertex x='0'/><object id='1'/></b:lattice>", item)))
    case("three_mf_twice.3mf", in_file(model(one, item * 2)), NO_SPHERE, "2 separate components")
    case("three_mf_flat_place.3mf", in_file(model(one, "<item objectid='1' transform='1 0 0 0 1 0 0 0 0 0 0 0'/>")), OK)
    bad("empty_archive", packed([]), "holds no model part")
    bad("zip_of_others", packed([("a.txt", "hello")]), "a ZIP archive (unpack it first)")
    bad("model_elsewhere", packed([("3D/other.model", plain)]), "holds no model part '3D/3dmodel.model'")
    bad("target_elsewhere", packed([("_rels/.rels", "<r><a Type='x/3dmodel' Target='/etc/passwd'/></r>"),
                                    ("3D/3dmodel.model", plain)]), "holds no model part '/etc/passwd'")
    bad("checksum", changed(whole.decode("latin-1"), "x='-1'", "x='-2'"), "its ZIP data is corrupt")
    bad("method_lzma", packed([("3D/3dmodel.model", plain)], zipfile.ZIP_LZMA), "packed by method 14")
    bad("bomb", packed([("3D/3dmodel.model", " " * (24 << 20))], zipfile.ZIP_DEFLATED), "malformed XML")
    for part in (30, len(whole) // 2, len(whole) - 30):
        bad("cut_%d" % part, whole[:part], "" if part == 30 else "without its directory")
    bad("no_build", in_file(model(one, "")), "holds no item")
    bad("item_of_nothing", in_file(model(one, "<item objectid='2'/>")), "object 2 is placed, and is not there")
    bad("component_of_itself", in_file(model(
        "<object id='1'><components>%s</components></object>" % ("<component objectid='1'/>" * 3), item)), "too deep")
    nested = "".join("<object id='%d'><components>%s</components></object>" %
                     (i, ("<component objectid='%d'/>" % (i + 1)) * 9) for i in range(1, 12))
    bad("a_billion_components", in_file(model(nested + one.replace("id='1'", "id='12'"), item)),
        "more than 100000")
    bad("vertex_beyond", in_file(changed(plain, "v1='0'", "v1='4'")), "names vertex 4 of 4")
    bad("vertex_negative", in_file(changed(plain, "v1='0'", "v1='-1'")), "names vertex -1 of 4")
    bad("vertex_huge", in_file(changed(plain, "v1='0'", "v1='99999999999999999999'")), "expected a number for v1")
    bad("vertex_twice", in_file(changed(plain, "v1='0' v2='2'", "v1='0' v2='0'")), "names a vertex twice")
    bad("coordinate_nan", in_file(changed(plain, "x='-1'", "x='nan'")), "not a finite number")
    bad("coordinate_huge", in_file(changed(plain, "x='-1'", "x='1e999'")), "expected a number for x")
    bad("coordinate_missing", in_file(changed(plain, "x='-1' ", "")), "expected a number for x")
    bad("transform_short", in_file(model(one, "<item objectid='1' transform='1 0 0'/>")), "twelve finite numbers")
    bad("transform_infinite", in_file(model(one, "<item objectid='1' transform='%s'/>" % ("inf " * 12))),
        "twelve finite numbers")
    bad("entities", in_file("<!DOCTYPE a [<!ENTITY x '1'>]>" + changed(plain, "x='-1'", "x='&x;'")[21:]),
        "declares an entity")
    bad("bad_tags", in_file(changed(plain, "</mesh>", "</mush>")), "malformed XML")
    bad("empty_model", in_file(""), "")


def make_all():
    make_three_mf()
