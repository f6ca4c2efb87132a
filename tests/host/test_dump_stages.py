# SPDX-License-Identifier: GPL-3.0-or-later
"""scripts/dump_stages.py writes what the six stages make, and says in a sentence why it can't."""
import subprocess
import sys

import numpy as np
import pymeshlab
import pytest

import pymeshlab_dcharts  # noqa: F401
from cases import REFUSED_MESHES, ROOT, STAGES, is_sentence, write_ply

MESH = ROOT / 'meshes' / 'torus.ply'
FILES = [f'{k}_{stage.removeprefix("dcharts_")}.ply' for k, stage in enumerate(STAGES, 1)]


def dump(*words):
    run = subprocess.run([sys.executable, ROOT / 'scripts' / 'dump_stages.py', *words], capture_output=True, text=True,
                         timeout=600)
    assert 'Traceback' not in run.stderr, run.stderr
    return run


def loaded(file):
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(file))
    return ms  # the mesh lives as long as its MeshSet


@pytest.fixture(scope='module')
def dumped(tmp_path_factory):
    folder = tmp_path_factory.mktemp('stages') / 'new' / 'folder'
    run = dump(MESH, folder, '--set', 'target_charts=3', '--set', 'max_fitting_error=0.1', '--set', 'seam_layer=true')
    assert run.returncode == 0, run.stderr
    return folder, run.stdout


def test_there_is_a_file_and_a_line_for_each_stage(dumped):
    folder, said = dumped
    assert sorted(path.name for path in folder.iterdir()) == FILES
    lines = said.splitlines()
    assert [line.split(':')[0] for line in lines] == [str(folder / name) for name in FILES]
    assert all(' charts ' in line and ' seams ' in line for line in lines)
    assert 'faces in none' in lines[0] and 'darts' in lines[4] and 'L2 stretch 1.0' in lines[5]


def test_each_file_is_what_the_stage_makes(dumped):
    folder, said = dumped
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(MESH))
    target, error = {'target_charts': 3}, {'max_fitting_error': 0.1}
    given = dict(zip(STAGES, ({**target, **error}, error, error, target, target, target)))
    for stage, name, line in zip(STAGES, FILES, said.splitlines()):
        figures = getattr(ms, stage)(**given[stage])
        assert f' charts {figures["charts"]},' in line
        written = loaded(folder / name)
        expected, got = ms.current_mesh(), written.current_mesh()
        assert np.array_equal(expected.face_matrix(), got.face_matrix()), name
        assert np.array_equal(expected.face_scalar_array(), got.face_scalar_array()), name
        assert np.array_equal(expected.face_color_matrix(), got.face_color_matrix()), name
        assert expected.has_wedge_tex_coord() == got.has_wedge_tex_coord() == (STAGES.index(stage) >= 4)
        if got.has_wedge_tex_coord():
            assert np.array_equal(expected.wedge_tex_coord_matrix().astype(np.float32),
                                  got.wedge_tex_coord_matrix().astype(np.float32)), name


def test_it_goes_on_from_a_file_of_its_own(dumped, tmp_path):
    folder, _ = dumped
    run = dump(folder / FILES[2], tmp_path, '--from', 'merge', '--set', 'target_charts=3')
    assert run.returncode == 0, run.stderr
    assert sorted(path.name for path in tmp_path.iterdir()) == FILES[3:]
    for name in FILES[3:]:
        assert (tmp_path / name).read_bytes() == (folder / name).read_bytes(), name


@pytest.mark.parametrize('words, sentence', [
    (['missing.ply'], 'missing.ply is not there.'),
    ([ROOT / 'README.md'], "README.md can't be read: Unknown format"),
    ([MESH, '--set', 'target_chart=3'], "No stage has a parameter 'target_chart'. Did you mean 'target_charts'?"),
    ([MESH, '--set', 'target_charts'], "--set needs NAME=VALUE, not 'target_charts'."),
    ([MESH, '--set', 'target_charts=few'], "target_charts is a whole number, not 'few'."),
    ([MESH, '--set', 'max_stretch=low'], "max_stretch is a number, not 'low'."),
    ([MESH, '--set', 'cut_to_disk=1'], "cut_to_disk is true or false, not '1'."),
    ([MESH, '--set', 'merge_by=Trial'], "merge_by is one of 'Trial Flattening', 'Boundary Region', not 'Trial'."),
    ([MESH, '--set', 'max_fitting_error=9'], 'max_fitting_error must be above 0 and at most 4; you gave 9.'),
])
def test_what_is_wrong_is_said(words, sentence, tmp_path):
    run = dump(words[0], tmp_path / 'out', *words[1:])
    assert run.returncode == 1 and sentence in run.stderr, run.stderr


def test_a_mesh_that_is_refused_and_a_folder_that_can_not_be_made(tmp_path):
    empty = write_ply(tmp_path / 'empty.ply', *REFUSED_MESHES['point cloud'])
    run = dump(empty, tmp_path / 'out')
    assert run.returncode == 1 and is_sentence(run.stderr), run.stderr
    run = dump(MESH, empty / 'out')
    assert run.returncode == 1 and "can't be made" in run.stderr
