# SPDX-License-Identifier: GPL-3.0-or-later
"""Files are written whole or not at all, to exactly the name that was given; nothing is left beside them, nothing is run."""
import contextlib
import os
import pathlib
import subprocess
import sys
import tempfile

import pytest

from cases import ROOT, is_sentence
from hosts import refused
from mlx import one_filter

pymeshlab = pytest.importorskip('pymeshlab')
pytest.importorskip('pymeshlab_dcharts')

CYLINDER = ROOT / 'meshes' / 'cylinder.ply'
SIZE = 200.0
KEPT_ALIVE = []  # see test_pymeshlab.py

# Names that a shell, an option parser or a printf would take for something else.
ODD_NAMES = ['a;touch x.svg', '$(touch x).svg', '`touch x`.svg', 'a\ntouch x.svg', '-o.svg', 'a|touch x.pdf', '%s%n%p.dxf', '<b>&"\'.svg',
             'a\nb.dxf', '\x01.svg', '~.svg', 'Schnittmuster äöü € 🧸.svg', '型紙.pdf', 'a b.DXF', '{x}.Svg', 'a.svg.part.svg', 'n' * 251 + '.svg']


def load():
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(CYLINDER))
    return ms


def contents(folder):
    """{path: bytes, or None for a folder} of everything below a folder."""
    return {str(p.relative_to(folder)): p.read_bytes() if p.is_file() else None for p in sorted(pathlib.Path(folder).rglob('*'))}


def refusal(file):
    """The sentence with which a pattern in that file is refused; no layer is added."""
    ms = load()
    KEPT_ALIVE.append(ms)
    with pytest.raises(pymeshlab.PyMeshLabException) as error:
        ms.dcharts_pattern(size=SIZE, output_file=str(file))
    assert is_sentence(str(error.value)), str(error.value)
    assert ms.mesh_number() == 1
    return str(error.value)


@contextlib.contextmanager
def mounted(folder, options):
    """A file system of its own in a folder: a small or a read-only one stops root, too."""
    folder.mkdir()
    mount = subprocess.run(['mount', '-t', 'tmpfs', '-o', options, 'tmpfs', str(folder)], capture_output=True, text=True)
    if mount.returncode != 0:
        pytest.skip(f'only root can mount a small disk, and not everywhere: {mount.stderr.strip()}')
    try:
        yield folder
    finally:
        subprocess.run(['umount', str(folder)], check=True)


@pytest.fixture
def full_disk(tmp_path):
    with mounted(tmp_path / 'disk', 'size=48k') as folder:
        yield folder


@pytest.fixture
def read_only(tmp_path):
    with mounted(tmp_path / 'disk', 'size=1m') as folder:
        (folder / 'old.svg').write_text('old')
        subprocess.run(['mount', '-o', 'remount,ro', str(folder)], check=True)
        yield folder


@pytest.mark.parametrize('name', ODD_NAMES, ids=lambda name: ascii(name)[:40])
def test_exactly_the_named_file(tmp_path, monkeypatch, name):
    (tmp_path / 'work').mkdir()
    monkeypatch.chdir(tmp_path / 'work')
    ms = load()
    ms.dcharts_pattern(size=SIZE, output_file=name)
    assert ms.mesh_number() == 2
    assert sorted(contents(tmp_path)) == ['work', f'work/{name}']
    content = (tmp_path / 'work' / name).read_bytes()
    check_format(content, pathlib.Path(name).suffix.lower())


def check_format(content, ending):
    """It can be read by other programs, whatever the title that is made of its name."""
    if ending == '.svg':
        import xml.etree.ElementTree as ElementTree
        assert ElementTree.fromstring(content).tag.endswith('svg')
    elif ending == '.dxf':
        import io
        import ezdxf
        assert len(ezdxf.read(io.StringIO(content.decode('ascii'))).modelspace()) > 0
    else:
        assert content.startswith(b'%PDF-') and content.rstrip().endswith(b'%%EOF')


def test_a_path_upwards(tmp_path, monkeypatch):
    for folder in ('work', 'beside'):
        (tmp_path / folder).mkdir()
    monkeypatch.chdir(tmp_path / 'work')
    load().dcharts_pattern(size=SIZE, output_file='../beside/a.svg')
    assert sorted(contents(tmp_path)) == ['beside', 'beside/a.svg', 'work']


def test_a_link_is_replaced(tmp_path):
    """What it points to is not what was named."""
    (tmp_path / 'other').write_text('old')
    (tmp_path / 'a.svg').symlink_to(tmp_path / 'other')
    load().dcharts_pattern(size=SIZE, output_file=str(tmp_path / 'a.svg'))
    assert (tmp_path / 'other').read_text() == 'old'
    assert not (tmp_path / 'a.svg').is_symlink()
    assert sorted(contents(tmp_path)) == ['a.svg', 'other']


@pytest.mark.parametrize('name', ['a.svg\0.svg', '.svg', '..', '/', 'file/a.svg', 'no folder/a.svg', 'n' * 252 + '.svg', 'folder.svg',
                                  'folder.svg/', '~/a.svg'], ids=lambda name: ascii(name)[:40])
def test_names_that_no_file_can_have(tmp_path, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    (tmp_path / 'file').write_text('old')
    (tmp_path / 'folder.svg').mkdir()
    before = contents(tmp_path)
    refusal(name)
    assert contents(tmp_path) == before


def test_a_write_protected_file(tmp_path):
    old = tmp_path / 'old.svg'
    old.write_text('old')
    old.chmod(0o444)
    assert 'write-protected' in refusal(old)
    assert contents(tmp_path) == {'old.svg': b'old'}


@pytest.mark.parametrize('ending', ['svg', 'pdf', 'dxf'])
def test_full_disk(full_disk, ending):
    for name, size in ((f'old.{ending}', 100), ('filler', 36 * 1024)):
        (full_disk / name).write_bytes(b'o' * size)
    before = contents(full_disk)
    for name in ('old', 'new'):
        assert 'space' in refusal(full_disk / f'{name}.{ending}')
        assert contents(full_disk) == before
    (full_disk / 'filler').unlink()
    subprocess.run(['mount', '-o', 'remount,size=4m', str(full_disk)], check=True)
    load().dcharts_pattern(size=SIZE, output_file=str(full_disk / f'new.{ending}'))  # there was nothing else wrong


def test_read_only_folder(read_only):
    before = contents(read_only)
    for name in ('old.svg', 'new.svg'):
        assert name in refusal(read_only / name)
    assert contents(read_only) == before


def test_a_folder_of_others():
    """As an ordinary user, in a folder of root."""
    if os.geteuid() != 0:
        pytest.skip('only root can become another user')
    code = """
import os, sys
import pymeshlab, pymeshlab_dcharts
ms = pymeshlab.MeshSet()
ms.load_new_mesh(sys.argv[1])
os.setgid(65534)
os.setuid(65534)
try:
    ms.dcharts_pattern(size=200.0, output_file=sys.argv[2])
except pymeshlab.PyMeshLabException as error:
    print(error)
"""
    with tempfile.TemporaryDirectory() as folder:
        os.chmod(folder, 0o755)
        file = os.path.join(folder, 'a.svg')
        run = subprocess.run([sys.executable, '-c', code, str(CYLINDER), file], capture_output=True, text=True, timeout=300)
        assert file in run.stdout and is_sentence(run.stdout.strip()), run.stdout + run.stderr
        assert contents(folder) == {}


# --- meshlabserver

@pytest.mark.parametrize('name', ['a;touch x.svg', '$(touch x).svg', '`touch x`.pdf', '-o.dxf', 'Schnittmuster äöü 🧸.svg', '../a.svg'])
def test_server_writes_exactly_the_named_file(server, tmp_path, name):
    folder = tmp_path / 'a' / 'b'
    folder.mkdir(parents=True)
    run, _ = server(one_filter(tmp_path, 'D-Charts: Pattern', size=SIZE, output_file=str(folder / name)), CYLINDER)
    assert run.returncode == 0, run.stdout[-2000:]
    wanted = os.path.normpath(folder / name)
    assert [p for p in contents(tmp_path / 'a') if p != 'b'] == [os.path.relpath(wanted, tmp_path / 'a')]
    assert not list(tmp_path.rglob('x'))


def test_server_full_disk(server, tmp_path, full_disk):
    (full_disk / 'old.svg').write_bytes(b'o' * 100)
    (full_disk / 'filler').write_bytes(b'o' * 36 * 1024)
    before = contents(full_disk)
    run, out = server(one_filter(tmp_path, 'D-Charts: Pattern', size=SIZE, output_file=str(full_disk / 'old.svg')), CYLINDER)
    refused(run, out)
    assert 'space' in run.stdout
    assert contents(full_disk) == before


# --- the demo

def run_demo(folder, mesh=CYLINDER):
    return subprocess.run([sys.executable, '-m', 'pymeshlab_dcharts.demo', str(mesh), str(folder)], capture_output=True, text=True,
                          timeout=600)


@pytest.mark.parametrize('size', ['100k', '400k'])
def test_demo_on_a_full_disk(tmp_path, size):
    """Cut off at the atlas, or later; the files of the run before stay."""
    with mounted(tmp_path / 'disk', f'size={size}') as disk:
        (disk / 'old').mkdir()
        (disk / 'old' / 'report.json').write_text('old')
        before = contents(disk)
        for folder in ('old', 'new'):
            run = run_demo(disk / folder)
            assert run.returncode == 1 and 'space' in run.stderr and 'Traceback' not in run.stderr, run.stderr
            assert contents(disk) == before


def test_demo_in_a_read_only_folder(read_only):
    before = contents(read_only)
    run = run_demo(read_only / 'new')
    assert run.returncode == 1 and 'can be written' in run.stderr and 'Traceback' not in run.stderr, run.stderr
    assert contents(read_only) == before


def test_demo_of_a_bad_mesh_leaves_nothing(tmp_path):
    bad = tmp_path / 'bad.ply'
    bad.write_text('no mesh\n')
    assert run_demo(tmp_path / 'new' / 'folder', bad).returncode == 1
    assert sorted(contents(tmp_path)) == ['bad.ply']
