# SPDX-License-Identifier: GPL-3.0-or-later
"""Where memory runs out, a host gets a sentence and goes on, and the mesh is what it was."""
import os
import pathlib
import resource
import subprocess
import sys
import time

import numpy as np
import pytest

from cases import is_sentence
from hosts import REFUSED
from mlx import one_filter

pymeshlab = pytest.importorskip('pymeshlab')
pytest.importorskip('pymeshlab_dcharts')

MB = 2**20

# Runs a filter with ever more memory, until it comes to its end; each time it must refuse with the sentence.
LESS_AND_LESS = """
import resource, sys
import numpy as np
import pymeshlab, pymeshlab_dcharts

name, mesh, output = sys.argv[1:4]
parameters = {'size': 300.0, 'output_file': output} if output else {}

def used():
    return int(open('/proc/self/statm').read().split()[0]) * resource.getpagesize()

def state(ms):
    m = ms.current_mesh()
    return [a().tobytes() for a in (m.vertex_matrix, m.face_matrix, m.face_scalar_array, m.face_color_matrix,
                                    m.wedge_tex_coord_matrix, m.face_selection_array)]

ms = pymeshlab.MeshSet()
ms.load_new_mesh(mesh)
ms.compute_texcoord_parametrization_triangle_trivial_per_wedge(sidedim=0)
ms.compute_scalar_by_function_per_face(q='fi * 0.37 - 5')
ms.compute_color_by_function_per_face(r='127 + 100 * sin(fi)', g='17', b='17', a='255')
before = state(ms)
refused = 0
for more in (0, 1, 2, 4, 8, 12, 16, 24, 32, 48, 64, 96, 128, 256, 512, 1024):
    resource.setrlimit(resource.RLIMIT_AS, (used() + more * 2**20, -1))
    try:
        ms.apply_filter(name, **parameters)
        finished = True
    except pymeshlab.PyMeshLabException as error:
        finished = False
        sentence = str(error)
    resource.setrlimit(resource.RLIMIT_AS, (-1, -1))
    if finished:
        break
    refused += 1
    print(f'{more} MB:', sentence.replace('\\n', ' '))
    assert 'not enough free memory' in sentence, sentence
    assert state(ms) == before, 'the mesh changed'
    assert ms.mesh_number() == 1
assert finished
print(f'refused {refused}')
"""


@pytest.fixture(scope='module')
def large_mesh(tmp_path_factory):
    """A sheet of 80,000 faces."""
    n = 200
    x, y = np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, n + 1))
    corner = np.arange(n * (n + 1)).reshape(n, n + 1)[:, :-1].ravel()
    faces = np.concatenate([np.stack([corner, corner + 1, corner + n + 2], 1), np.stack([corner, corner + n + 2, corner + n + 1], 1)])
    ms = pymeshlab.MeshSet()
    ms.add_mesh(pymeshlab.Mesh(np.stack([x.ravel(), y.ravel(), np.sin(5 * x * y).ravel()], 1), faces))
    file = tmp_path_factory.mktemp('memory') / 'sheet.ply'
    ms.save_current_mesh(str(file))
    return file


@pytest.mark.parametrize('name, output, threads', [('dcharts_texture_atlas', '', 1), ('dcharts_texture_atlas', '', 8),
                                                   ('dcharts_pattern', 'a.pdf', 2), ('dcharts_pattern', 'a.svg', 2)])
def test_pymeshlab(tmp_path, plush, name, output, threads):
    file = str(tmp_path / output) if output else ''
    run = subprocess.run([sys.executable, '-c', LESS_AND_LESS, name, str(plush), file], capture_output=True, text=True, timeout=900,
                         env={**os.environ, 'OMP_NUM_THREADS': str(threads)})
    assert run.returncode == 0, run.stdout[-2000:] + run.stderr[-2000:]
    sentences = [line.split(': ', 1)[1] for line in run.stdout.splitlines() if ' MB: ' in line]
    assert sentences and all(is_sentence(sentence) for sentence in sentences), run.stdout
    assert [p.name for p in tmp_path.iterdir()] == ([output] if output else [])


def largest_address_space(process):
    """In bytes; waits for the process."""
    largest = 0
    while process.poll() is None:
        try:
            status = pathlib.Path(f'/proc/{process.pid}/status').read_text()
        except OSError:
            continue
        peaks = [int(line.split()[1]) for line in status.splitlines() if line.startswith('VmPeak')]
        largest = max([largest, *peaks])
        time.sleep(0.005)
    return largest * 1024


def test_meshlabserver(meshlab_2020, screen, tmp_path, large_mesh):
    """With as much memory as it takes to open the mesh and to measure it, and not much more."""

    def command(name):
        (tmp_path / 'out.ply').unlink(missing_ok=True)
        return [str(meshlab_2020.bin / 'meshlabserver'), '-i', str(large_mesh), '-o', str(tmp_path / 'out.ply'), '-m', 'fq', '-s',
                str(one_filter(tmp_path, name))]

    def run(name, **options):
        return subprocess.Popen(command(name), env={**screen.env, 'OMP_NUM_THREADS': '4'}, cwd=tmp_path, stdin=subprocess.DEVNULL,
                                stderr=subprocess.STDOUT, text=True, errors='replace', **options)

    enough = largest_address_space(run('D-Charts: Measure', stdout=subprocess.DEVNULL))
    refusals = 0
    for more in (0, 8, 16, 32):
        limit = enough + more * MB
        process = run('D-Charts: Texture Atlas', stdout=subprocess.PIPE,
                      preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
        log, _ = process.communicate(timeout=600)
        assert process.returncode in (0, REFUSED), f'{more} MB, exit code {process.returncode}: {log[-2000:]}'
        if process.returncode == REFUSED:
            assert 'not enough free memory' in log, log[-2000:]
            assert not (tmp_path / 'out.ply').exists()
            refusals += 1
    assert refusals > 0
