# SPDX-License-Identifier: GPL-3.0-or-later
"""Patterns of models 240 mm long, made in pymeshlab: once for all tests, as some take their time."""
import functools
import pathlib
import tempfile

SIZE = 240.0  # mm
MODELS = {
    'plush': 'Fabric',
    'bishop': 'Fabric',
    'bunny': 'Fabric',
    'spot': 'Fabric',
    'fandisk_9926': 'Paper',
}
ENDINGS = ('svg', 'pdf', 'dxf')
_FOLDER = tempfile.TemporaryDirectory(prefix='dcharts-patterns-')


@functools.cache
def made_pattern(mesh_file, material, ending):
    """(MeshSet, the file that was written)."""
    import pymeshlab
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(mesh_file))
    file = pathlib.Path(tempfile.mkdtemp(dir=_FOLDER.name)) / f'pattern.{ending}'
    ms.dcharts_pattern(material=material, size=SIZE, output_file=str(file))
    return ms, file
