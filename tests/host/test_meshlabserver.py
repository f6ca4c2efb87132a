# SPDX-License-Identifier: GPL-3.0-or-later
"""meshlabserver of MeshLab 2020.09: the shipped scripts, wrong input, the log, and the same charts as in pymeshlab."""
import re

import numpy as np
import pytest

from atlas_check import ply_layers
from cases import EXAMPLES, FILTERS, OUT_OF_RANGE, REFUSED_MESHES, shipped_meshes, write_ply
from hosts import refused
from mlx import one_filter, read_script

pymeshlab = pytest.importorskip('pymeshlab')
pytest.importorskip('pymeshlab_dcharts')

SCRIPTS = ('texture_atlas.mlx', 'stages.mlx', 'paper.mlx')
MESHES = shipped_meshes()


def test_plugin_is_found(meshlab_2020):
    assert meshlab_2020.installed.returncode == 0, meshlab_2020.installed.stderr
    assert (meshlab_2020.plugins / 'libfilter_dcharts_2020.so').exists()


@pytest.mark.parametrize('script', SCRIPTS)
@pytest.mark.parametrize('mesh', MESHES, ids=lambda path: path.stem)
def test_shipped_script(server, script, mesh):
    run, out = server(EXAMPLES / script, mesh)
    assert run.returncode == 0, run.stdout[-2000:]
    assert out is not None, run.stdout[-2000:]
    there = ply_layers(out)
    here = pymeshlab.MeshSet()
    here.load_new_mesh(str(mesh))
    for name, values in read_script(EXAMPLES / script):
        here.apply_filter(name, **values)
    expected = here.current_mesh()
    assert np.array_equal(there.face_vertices, expected.face_matrix())
    assert np.array_equal(there.quality, expected.face_scalar_array()), 'other charts than in pymeshlab'
    assert there.texcoords.min() >= 0 and there.texcoords.max() <= 1
    assert len(np.unique(there.colors, axis=0)) >= min(3, len(np.unique(there.quality)))


def test_conformal_atlas(server, tmp_path, plush):
    """The method of an atlas in a script: other texcoords than the default's, with less shear."""
    shear, texcoords = {}, {}
    for method in range(2):
        run, out = server(one_filter(tmp_path, 'D-Charts: Texture Atlas', method=method), plush)
        assert run.returncode == 0 and out is not None, run.stdout[-2000:]
        shear[method] = float(re.search(r'\bl2_shear\b\W+([0-9.e+-]+)', run.stdout)[1])
        texcoords[method] = ply_layers(out).texcoords
        assert texcoords[method].min() >= 0 and texcoords[method].max() <= 1
    assert not np.array_equal(texcoords[0], texcoords[1])
    assert shear[1] < shear[0]


def test_target_charts(server, tmp_path, plush):
    run, out = server(one_filter(tmp_path, 'D-Charts: Texture Atlas', target_charts=7), plush)
    assert run.returncode == 0 and out is not None, run.stdout[-2000:]
    assert re.search(r'\bcharts\b\W+([0-9]+)', run.stdout)[1] == '7'
    assert np.array_equal(np.unique(ply_layers(out).quality), np.arange(7))


def test_log_has_the_figures(server, plush):
    run, _ = server(EXAMPLES / 'texture_atlas.mlx', plush)
    for figure in ('charts', 'l2_stretch', 'linf_stretch', 'l2_shear', 'seam_length', 'flipped_faces',
                   'overlapping_faces', 'packing_efficiency', 'seconds'):
        assert re.search(rf'\b{figure}\b\W+[0-9]', run.stdout), f'no {figure} in the log:\n{run.stdout[-2000:]}'


@pytest.mark.parametrize('name', FILTERS)
def test_no_mesh(server, tmp_path, name):
    run, out = server(one_filter(tmp_path, name))
    refused(run, out)
    assert 'mesh' in run.stdout


@pytest.mark.parametrize('name', FILTERS)
@pytest.mark.parametrize('kind', REFUSED_MESHES)
def test_refused_mesh(server, tmp_path, name, kind):
    mesh = write_ply(tmp_path / 'wrong.ply', *REFUSED_MESHES[kind])
    refused(*server(one_filter(tmp_path, name), mesh))


@pytest.mark.parametrize('parameter', OUT_OF_RANGE)
def test_out_of_range(server, tmp_path, plush, parameter):
    name = next(name for name, (_, parameters) in FILTERS.items() if parameter in parameters)
    run, out = server(one_filter(tmp_path, name, **{parameter: OUT_OF_RANGE[parameter][0]}), plush)
    refused(run, out)
    assert parameter in run.stdout


def test_pattern_is_that_of_pymeshlab(server, tmp_path, plush):
    """The shipped script writes its PDF, and an SVG has the same bytes as in pymeshlab; the mesh is not changed."""
    run, out = server(EXAMPLES / 'pattern.mlx', plush)
    assert run.returncode == 0 and out is not None, run.stdout[-2000:]
    assert (tmp_path / 'pattern.pdf').read_bytes().startswith(b'%PDF-')
    run, out = server(one_filter(tmp_path, 'D-Charts: Pattern', size=200, output_file='there.svg'), plush)
    assert run.returncode == 0 and out is not None, run.stdout[-2000:]
    here = pymeshlab.MeshSet()
    here.load_new_mesh(str(plush))
    (tmp_path / 'here').mkdir()
    values = dict(read_script(EXAMPLES / 'pattern.mlx'))['dcharts_pattern']
    here.apply_filter('dcharts_pattern', **{**values, 'size': 200.0, 'output_file': str(tmp_path / 'here' / 'there.svg')})
    assert (tmp_path / 'there.svg').read_bytes() == (tmp_path / 'here' / 'there.svg').read_bytes()


@pytest.mark.parametrize('file', ['pattern.txt', 'pattern', 'no_such_folder/pattern.svg'])
def test_pattern_file_that_cannot_be(server, tmp_path, plush, file):
    refused(*server(one_filter(tmp_path, 'D-Charts: Pattern', output_file=file), plush))
    assert not (tmp_path / file).exists()
