# SPDX-License-Identifier: GPL-3.0-or-later
"""The same bytes in every process, whatever the number of threads."""
import os
import subprocess
import sys

import pytest

pytest.importorskip('pymeshlab')
pytest.importorskip('pymeshlab_dcharts')

CODE = """
import sys
import pymeshlab, pymeshlab_dcharts

ms = pymeshlab.MeshSet()
ms.load_new_mesh(sys.argv[1])
figures = ms.dcharts_texture_atlas()
ms.save_current_mesh(sys.argv[2] + '/atlas.ply')
ms.dcharts_pattern(size=300.0, output_file=sys.argv[2] + '/pattern.svg')
print(sorted((name, value) for name, value in figures.items() if not name.startswith('seconds')))
"""


def everything(folder, mesh, threads):
    """What a process prints and writes."""
    folder.mkdir()
    env = {name: value for name, value in os.environ.items() if name != 'OMP_NUM_THREADS'}
    run = subprocess.run([sys.executable, '-c', CODE, str(mesh), str(folder)], capture_output=True, text=True, timeout=900,
                         env={**env, **({'OMP_NUM_THREADS': threads} if threads else {})})
    assert run.returncode == 0, run.stderr
    return run.stdout, {path.name: path.read_bytes() for path in folder.iterdir()}


def test_any_number_of_threads(tmp_path, model_file):
    mesh = model_file('bishop')
    expected = everything(tmp_path / 'all', mesh, '')
    assert sorted(expected[1]) == ['atlas.ply', 'pattern.svg']
    for threads in ('1', '2', '8'):
        printed, files = everything(tmp_path / threads, mesh, threads)
        assert printed == expected[0]
        assert [name for name in files if files[name] != expected[1][name]] == [], f'{threads} threads'
