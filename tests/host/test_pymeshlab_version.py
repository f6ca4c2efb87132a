# SPDX-License-Identifier: GPL-3.0-or-later
"""Beside a pymeshlab that the plugin does not fit, the import says which one does."""
import os
import subprocess
import sys

import pytest


def import_beside(folder, version):
    """Imports the package where pymeshlab says of itself that it is `version`."""
    record = folder / f'pymeshlab-{version}.dist-info'
    record.mkdir()
    (record / 'METADATA').write_text(f'Metadata-Version: 2.1\nName: pymeshlab\nVersion: {version}\n')
    return subprocess.run([sys.executable, '-c', 'import pymeshlab_dcharts'], env={**os.environ, 'PYTHONPATH': str(folder)},
                          capture_output=True, text=True)


@pytest.mark.parametrize('version', ['2023.12.post3', '2025.70', '2026.1'])
def test_another_version_is_refused_with_the_right_one(tmp_path, version):
    run = import_beside(tmp_path, version)
    assert run.returncode == 1
    assert run.stderr.splitlines()[-1] == (
        f"ImportError: pymeshlab_dcharts works with pymeshlab 2025.7, but pymeshlab {version} is installed. "
        "Install the right one: pip install 'pymeshlab==2025.7.*'")


@pytest.mark.parametrize('version', ['2025.7', '2025.7.post1'])
def test_the_right_one_is_taken(tmp_path, version):
    run = import_beside(tmp_path, version)
    assert run.returncode == 0, run.stderr
