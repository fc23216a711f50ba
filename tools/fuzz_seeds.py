#!/usr/bin/env python3
"""Small valid files of every own parser, for the fuzzers to start from: fuzz_seeds.py FOLDER.

Makes FOLDER/PARSER/NAME. All are one unit tet with a face, under a kilobyte, so that changes of
single bytes hit something.
"""
import base64
import struct
import sys
from pathlib import Path

POINTS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
FACE, TET = (1, 3, 2), (1, 2, 3, 4)


def words(numbers):
    return " ".join(str(n) for n in numbers)


def gmsh():
    names = '$PhysicalNames\n2\n2 1 "wall"\n3 2 "fluid"\n$EndPhysicalNames\n'
    xyz = "".join(words(p) + "\n" for p in POINTS)
    yield "v41", (
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" + names
        + "$Entities\n0 0 1 1\n1 0 0 0 1 1 0 1 1 0\n1 0 0 0 1 1 1 1 2 1 1\n$EndEntities\n"
        + "$Nodes\n2 4 1 4\n2 1 1 3\n1\n2\n3\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 1 0 1\n4\n0 0 1\n"
        + "$EndNodes\n$Elements\n2 2 1 2\n2 1 2 1\n1 1 3 2\n3 1 4 1\n2 1 2 3 4\n$EndElements\n"
    ).encode()
    yield "v22", (
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + names + "$Nodes\n4\n"
        + "".join(f"{i + 1} {words(p)}\n" for i, p in enumerate(POINTS))
        + "$EndNodes\n$Elements\n2\n1 2 2 1 1 1 3 2\n2 4 2 2 1 1 2 3 4\n$EndElements\n"
    ).encode()
    binary = b"$MeshFormat\n4.1 1 8\n" + struct.pack("<i", 1) + b"\n$EndMeshFormat\n$Nodes\n"
    binary += struct.pack("<4Q", 1, 4, 1, 4) + struct.pack("<3iQ", 3, 1, 0, 4)
    binary += struct.pack("<4Q", 1, 2, 3, 4) + b"".join(struct.pack("<3d", *p) for p in POINTS)
    binary += b"\n$EndNodes\n$Elements\n" + struct.pack("<4Q", 1, 1, 1, 1)
    binary += struct.pack("<3iQ", 3, 1, 4, 1) + struct.pack("<5Q", 1, *TET) + b"\n$EndElements\n"
    yield "v41b", binary
    old = b"$MeshFormat\n2.2 1 8\n" + struct.pack("<i", 1) + b"\n$EndMeshFormat\n$Nodes\n4\n"
    old += b"".join(struct.pack("<i3d", i + 1, *p) for i, p in enumerate(POINTS))
    old += b"\n$EndNodes\n$Elements\n1\n" + struct.pack("<3i", 4, 1, 2)
    yield "v22b", old + struct.pack("<7i", 1, 1, 1, *TET) + b"\n$EndElements\n"
    yield "periodic", (
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 " + xyz.replace("\n", "\n2 ", 1)
        + "$EndNodes\n$Periodic\n1\n2 1 2\n1\n1 2\n$EndPeriodic\n"
    ).encode()


def meshb():
    def section(order, version, code, lines, end):
        place = "q" if version >= 3 else "i"
        whole = "q" if version == 4 else "i"
        data = struct.pack(order + whole, len(lines)) if code != 3 else b""
        for line in lines:
            for number in line:
                real = "f" if version == 1 else "d"
                data += struct.pack(order + (real if isinstance(number, float) else whole), number)
        start = end + 4 + struct.calcsize("=" + place)
        return struct.pack(order + "i" + place, code, start + len(data)) + data

    lines = {
        4: [tuple(float(x) for x in p) + (0,) for p in POINTS],
        5: [(1, 2, 1)],
        6: [FACE + (1,)],
        8: [TET + (1,)],
        40: [(1, 1)],
        41: [(2, 1, 0.5, 0.0)],
        42: [(3, 1, 0.5, 0.5, 0.0)],
        15: [(1,)],
    }
    for version in (1, 2, 3, 4):
        for order in "<>":
            file = struct.pack(order + "2i", 1, version)
            place = "q" if version >= 3 else "i"
            here = len(file) + 4 + struct.calcsize("=" + place) + 4
            file += struct.pack(order + "i" + place + "i", 3, here, 3)
            for code, rows in lines.items():
                file += section(order, version, code, rows, len(file))
            yield f"v{version}{'b' if order == '>' else 'l'}", file + struct.pack(
                order + "i" + place, 54, 0)
    yield "text", (
        "MeshVersionFormatted 2\nDimension 3\n# points\nVertices\n4\n"
        + "".join(words(p) + " 0\n" for p in POINTS)
        + "Edges 1 1 2 1\nTriangles\n1\n1 3 2 1\nTetrahedra\n1\n1 2 3 4 1\nRequiredVertices 1 1\n"
        + "VerticesOnGeometricEdges 1\n1 1 0.5 0\nPyramids 0 Prisms 0 Hexahedra 0\nEnd\n"
    ).encode()


def meshlink():
    yield "mini", (
        '<MeshLink version="1.0"><Attribute attid="1" name="geometry format">STEP</Attribute>'
        '<AttributeGroup attid="2">1</AttributeGroup><GeometryFile filename="b.step">'
        '<GeometryReference gid="1" ref="face_1"/><GeometryReference gid="2" ref="edge_2"/>'
        '</GeometryFile><GeometryGroup gid="9" name="w">1 2</GeometryGroup>'
        '<MeshFile filename="b.cgns"><MeshModelReference ref="/B/z"><MeshSheet name="d" gref="9">'
        '<ParamVertex vref="1" gref="1" dim="2">0.5 0.5</ParamVertex>'
        '<MeshFace etype="Tri3" count="1">1 2 3</MeshFace>'
        '<MeshFace etype="Tri3" format="base64" count="1">BQAAAAYAAAAHAAAA</MeshFace></MeshSheet>'
        '<MeshString name="c" gref="2"><MeshEdge etype="Edge2">1 2</MeshEdge></MeshString>'
        '<MeshPointReference gref="2">1</MeshPointReference></MeshModelReference></MeshFile>'
        '<Transform xid="1">1 0 0 0 0 1 0 0 0 0 1 0 0 2 0 1</Transform></MeshLink>'
    ).encode()


def stl():
    yield "text", (
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1e0 0\n"
        "endloop\nendfacet\nendsolid a\n"
    ).encode()
    yield "binary", bytes(80) + struct.pack("<I12fH", 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0)


def su2():
    xyz = "".join(f"{words(p)} {i}\n" for i, p in enumerate(POINTS))
    yield "linear", (
        "NDIME= 3\nNELEM= 1\n10 0 1 2 3 0\nNPOIN= 4\n" + xyz
        + "NMARK= 1\nMARKER_TAG= wall\nMARKER_ELEMS= 1\n5 0 2 1\n% end\n"
    ).encode()
    yield "quadratic", (
        "NZONE= 1\nNDIME= 3\nNELEM= 1\n110 0 1 2 3 0 1 2 3 0 1\nNPOIN= 4\n" + xyz
        + "NMARK= 1\nMARKER_TAG= wall\nMARKER_ELEMS= 1\n105 0 2 1 0 1 2\n"
    ).encode()


def ugrid():
    yield "text", ("\0" + "4 1 0 1 0 0 0\n" + "".join(words(p) + "\n" for p in POINTS)
                   + "1 3 2\n7\n1 2 3 4\n").encode()
    for kind, order, records in ((1, ">", False), (2, "<", False), (3, ">", True), (4, "<", True)):
        head = struct.pack(order + "7i", 4, 1, 0, 1, 0, 0, 0)
        body = b"".join(struct.pack(order + "3d", *p) for p in POINTS)
        body += struct.pack(order + "8i", *FACE, 7, *TET)
        if records:
            head, body = (struct.pack(order + "i", len(r)) + r + struct.pack(order + "i", len(r))
                          for r in (head, body))
        yield f"kind{kind}", bytes([kind]) + head + body


def vtu():
    def file(data):
        def array(kind, name, values, parts=""):
            return (f'<DataArray type="{kind}" Name="{name}" {parts}'
                    f'format="{data}">{encode(kind, values)}</DataArray>')

        def encode(kind, values):
            if data == "ascii":
                return words(values)
            raw = struct.pack("<%d%s" % (len(values), {"Float64": "d", "Int64": "q",
                                                       "UInt8": "B"}[kind]), *values)
            return base64.b64encode(struct.pack("<I", len(raw)) + raw).decode()

        return (
            '<VTKFile type="UnstructuredGrid" version="2.2" byte_order="LittleEndian">'
            '<UnstructuredGrid><Piece NumberOfPoints="4" NumberOfCells="2"><Points>'
            + array("Float64", "Points", [x for p in POINTS for x in p], 'NumberOfComponents="3" ')
            + "</Points><Cells>" + array("Int64", "connectivity", [0, 2, 1, 0, 1, 2, 3])
            + array("Int64", "offsets", [3, 7]) + array("UInt8", "types", [5, 10])
            + '</Cells><CellData>' + array("Int64", "entity", [7, 1])
            + "</CellData></Piece></UnstructuredGrid></VTKFile>"
        ).encode()

    yield "ascii", file("ascii")
    yield "base64", file("binary")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    for parser in (gmsh, meshb, meshlink, stl, su2, ugrid, vtu):
        folder = Path(sys.argv[1]) / parser.__name__
        folder.mkdir(parents=True, exist_ok=True)
        for name, content in parser():
            (folder / name).write_bytes(content)
