# SPDX-License-Identifier: GPL-3.0-or-later
"""The GUI of MeshLab 2025.07 (float): does it take the plugin, and what is then to be seen."""
import shutil
import tempfile

import pytest

from forky import inside
from hosts import install
from meshlab_gui import MeshlabGui


@pytest.fixture(scope='module')
def home(forky):
    """A home folder in forky's own tree, as MeshLab leaves it after its first start, with the plugin installed."""
    folder = tempfile.mkdtemp(prefix='home-', dir=forky / 'root')
    home = forky / 'root' / folder
    plugins = home / '.local/share/VCG/MeshLab_64bit_fp/MeshLabExtraPlugins/2025.07'
    plugins.mkdir(parents=True)
    run = install(home=home)
    assert run.returncode == 0, run.stderr
    assert (plugins / 'libfilter_dcharts_2025.so').exists(), run.stdout
    yield home
    shutil.rmtree(home)


@pytest.mark.parametrize('name', ['D-Charts: Texture Atlas', 'D-Charts: Pattern'])
def test_filter_colors_the_charts(screen, forky, home, large_plush, screenshots, name):
    shutil.copy(large_plush, home / 'plush.ply')
    at_home = '/' + str(home.relative_to(forky))
    gui = MeshlabGui(screen, inside(forky, 'meshlab'), f'{at_home}/plush.ply',
                     env={'HOME': at_home, 'XDG_RUNTIME_DIR': at_home})
    try:
        before = gui.colors()
        try:
            gui.apply(name)
        finally:
            screen.save_screen(screenshots / f'2025 {name}.png'.replace(': ', ' '))
        assert gui.has_line(r'\bcharts\b\W+[0-9]'), gui.output[-2000:]
        # Of a pattern's layer only a part is in view.
        assert gui.colors() >= before + (1 if name.endswith('Pattern') else 3), 'no coloured charts on the screen'
    finally:
        gui.close()
