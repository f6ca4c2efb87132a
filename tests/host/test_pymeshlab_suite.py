# SPDX-License-Identifier: GPL-3.0-or-later
"""pymeshlab's own tests and examples, which are in its wheel, come out with our plugin loaded as they do without."""
import pathlib
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

import pytest

pymeshlab = pytest.importorskip('pymeshlab')
pytest.importorskip('pymeshlab_dcharts')

SUITE = pathlib.Path(pymeshlab.__file__).parent / 'tests'
# It says how many plugins the wheel has: one more that is loaded is one too many for it, whatever the plugin.
COUNT = 'test_number_plugins'
# These draw with OpenGL, and one of them ends the process on a screen without a graphics card.
DRAWING = ('test_ambient_occlusion', 'test_texture_map_defragmentation')


def run_suite(folder, *options, plugin, env=None):
    """{test: passed, failed or skipped}, and 'process' when it did not come to its end. It runs on a copy: it writes."""
    folder.mkdir()
    shutil.copytree(SUITE, folder / 'tests', ignore=shutil.ignore_patterns('__pycache__'))
    results = folder / 'results.xml'
    command = [sys.executable, '-m', 'pytest', '-q', '-p', 'no:cacheprovider', '-W', 'ignore', f'--junit-xml={results}',
               '-o', 'python_files=test_*.py example_*.py', '-o', 'python_functions=test_* example_*']
    command += ['-p', 'pymeshlab_dcharts'] if plugin else []  # pytest imports it before the tests
    run = subprocess.run([*command, *options], cwd=folder, env=env, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                         timeout=600)
    if not results.exists():
        return {'process': run.returncode}
    outcomes = {}
    for case in ElementTree.parse(results).iter('testcase'):
        flaw = next((child.tag for child in case if child.tag in ('failure', 'error', 'skipped')), 'passed')
        outcomes[case.get('name')] = flaw
    return outcomes


def test_same_outcomes(tmp_path):
    options = ('-m', 'not glcontext', 'tests')
    without = run_suite(tmp_path / 'without', *options, plugin=False)
    loaded = run_suite(tmp_path / 'loaded', *options, plugin=True)
    assert without.pop(COUNT) == 'passed'
    assert loaded.pop(COUNT) == 'failure'  # so the plugin was loaded
    assert loaded == without
    assert len(without) >= 20 and set(without.values()) == {'passed'}


@pytest.mark.parametrize('name', DRAWING)
def test_same_outcome_with_opengl(tmp_path, screen, name):
    options = (f'tests/{name}.py',)
    without = run_suite(tmp_path / 'without', *options, plugin=False, env=screen.env)
    assert run_suite(tmp_path / 'loaded', *options, plugin=True, env=screen.env) == without


def test_one_plugin_more():
    code = 'import pymeshlab; before = pymeshlab.plugin_number(); import pymeshlab_dcharts; print(pymeshlab.plugin_number() - before)'
    run = subprocess.run([sys.executable, '-c', code], capture_output=True, text=True, timeout=300)
    assert run.stdout.split() == ['1'], run.stdout + run.stderr
