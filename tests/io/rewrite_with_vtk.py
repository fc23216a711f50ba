"""Reads a .vtu file with VTK and writes it again.

usage: rewrite_with_vtk.py IN.vtu OUT.vtu MODE     MODE: ascii, binary, base64, raw or compressed
Ends with 77 if VTK is not installed.
"""
import sys

try:
    import vtk
except ImportError:
    sys.exit(77)


def main():
    source, target, mode = sys.argv[1:]
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(source)
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetInputConnection(reader.GetOutputPort())
    writer.SetFileName(target)
    if mode != 'compressed':
        writer.SetCompressorTypeToNone()
    if mode == 'ascii':
        writer.SetDataModeToAscii()
    elif mode == 'binary':
        writer.SetDataModeToBinary()
    else:
        writer.SetDataModeToAppended()
        writer.SetEncodeAppendedData(mode == 'base64')
        if mode == 'base64':
            writer.SetHeaderTypeToUInt32()
    return 0 if writer.Write() else 1


if __name__ == '__main__':
    sys.exit(main())
