"""The data sets and attributes of an HDF5 file as NumPy arrays: with h5py, else with the C library itself."""
import ctypes
import ctypes.util

import numpy as np


def _with_library(path):
    name = ctypes.util.find_library('hdf5_serial') or ctypes.util.find_library('hdf5')
    if name is None:
        raise ImportError('no HDF5')
    lib = ctypes.CDLL(name)
    hid, size = ctypes.c_int64, ctypes.c_uint64
    lib.H5open()

    def call(function, *arguments, result=hid):
        f = getattr(lib, function)
        f.restype = result
        answer = f(*arguments)
        if isinstance(answer, int) and answer < 0:
            raise OSError(function)
        return answer

    def number_type(kind):
        return hid(hid.in_dll(lib, f'H5T_NATIVE_{kind}_g').value)

    def get(item, type_of, space_of, read):
        kind, space = hid(call(type_of, item)), hid(call(space_of, item))
        count = call('H5Sget_simple_extent_ndims', space, result=ctypes.c_int)
        shape = (size * count)()
        call('H5Sget_simple_extent_dims', space, shape, None, result=ctypes.c_int)
        length = call('H5Tget_size', kind, result=ctypes.c_size_t)
        what = call('H5Tget_class', kind, result=ctypes.c_int)
        if what == 3:  # text
            data = np.zeros(tuple(shape), f'S{length}')
            memory = kind
        else:
            data = np.zeros(tuple(shape), 'f8' if what == 1 else 'i4')
            memory = number_type('DOUBLE' if what == 1 else 'INT32')
        pointer = ctypes.c_void_p(data.ctypes.data)
        if read == 'H5Aread':
            call(read, item, memory, pointer, result=ctypes.c_int)
        else:
            call(read, item, memory, hid(0), hid(0), hid(0), pointer, result=ctypes.c_int)
        return data

    file = hid(call('H5Fopen', path.encode(), ctypes.c_uint(0), hid(0)))
    sets, attributes = {}, {}
    for name in ('ElemInfo', 'SideInfo', 'NodeCoords', 'GlobalNodeIDs', 'BCNames', 'BCType',
                 'ElemBarycenters', 'ElemWeight', 'ElemCounter'):
        item = hid(call('H5Dopen2', file, name.encode(), hid(0)))
        sets[name] = get(item, 'H5Dget_type', 'H5Dget_space', 'H5Dread')
    for name in ('Version', 'Ngeo', 'nElems', 'nSides', 'nNodes', 'nUniqueSides', 'nUniqueNodes', 'nBCs',
                 'FEMconnect'):
        item = hid(call('H5Aopen', file, name.encode(), hid(0)))
        attributes[name] = get(item, 'H5Aget_type', 'H5Aget_space', 'H5Aread')
    call('H5Fclose', file, result=ctypes.c_int)
    return sets, attributes


def read(path):
    """Returns ({name: array}, {attribute: array}). Raises ImportError where HDF5 is not installed."""
    try:
        import h5py
    except ImportError:
        return _with_library(path)
    with h5py.File(path, 'r') as f:
        return {k: f[k][()] for k in f}, {k: np.asarray(v) for k, v in f.attrs.items()}
