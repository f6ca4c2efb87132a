# SPDX-License-Identifier: GPL-3.0-or-later
"""Every file, link and filter that the pages name exists, every page is linked, and none names a place on somebody's
machine."""
import pathlib
import re

import pytest

import pymeshlab_dcharts

ROOT = pathlib.Path(__file__).parents[2]
PAGES = {str(path.relative_to(ROOT)): path.read_text(encoding='utf-8')
         for path in (*ROOT.glob('*.md'), *(ROOT / 'docs').glob('*.md'), ROOT / 'tests' / 'README.md')}
FOLDERS = ('benchmarks', 'cmake', 'docs', 'examples', 'filter_dcharts', 'meshes', 'python', 'scripts', 'tests',
           'vcg_ext')


def anchors(text):
    """What GitHub names the headings."""
    return {re.sub(r'[^\w -]', '', heading).strip().lower().replace(' ', '-')
            for heading in re.findall(r'(?m)^#+ (.*)', re.sub(r'(?s)```.*?```', '', text))}


def named_files(text):
    """Paths from the top folder; not those in other addresses and folders."""
    for match in re.finditer(rf'(?<![\w./-])(?:{"|".join(FOLDERS)})/[\w./-]*', text):
        yield match.group().rstrip('.')


def exists(path):
    """A name without an ending stands for the .h and .cpp of that name."""
    return path.exists() or (path.suffix == '' and path.with_suffix('.h').exists())


def test_the_pages_are_there():
    assert {'README.md', 'CONTRIBUTING.md', 'CHANGELOG.md', 'docs/how-it-works.md', 'docs/gallery.md',
            'docs/benchmarks.md', 'docs/recipes.md', 'docs/filters.md', 'docs/troubleshooting.md'} <= set(PAGES)
    assert len(list(named_files(PAGES['docs/how-it-works.md']))) > 40


@pytest.mark.parametrize('page', PAGES)
def test_links_lead_somewhere(page):
    for link in re.findall(r'\]\(([^)\s]+)\)', PAGES[page]):
        if re.match(r'https?:', link):
            continue
        file, _, anchor = link.partition('#')
        target = (ROOT / page).parent / file if file else ROOT / page
        assert target.exists(), link
        assert not anchor or anchor in anchors(target.read_text(encoding='utf-8')), link


@pytest.mark.parametrize('page', PAGES)
def test_every_file_that_is_named_exists(page):
    for name in named_files(PAGES[page]):
        assert exists(ROOT / name), name


@pytest.mark.parametrize('page', PAGES)
def test_filters_that_are_called_exist(page):
    called = set(re.findall(r'(?:\w|\))\.(dcharts_\w+)', PAGES[page]))
    assert called <= set(pymeshlab_dcharts.filters)


@pytest.mark.parametrize('page', PAGES)
def test_no_page_names_a_place_on_somebodys_machine(page):
    assert not re.search(r'(?<![\w.])/(?:home|root|tmp|work|Users)/', PAGES[page])


def test_every_page_is_linked_from_the_readme_or_from_contributing():
    for page in (page for page in PAGES if page.startswith('docs/')):
        assert any(f']({page})' in PAGES[start] for start in ('README.md', 'CONTRIBUTING.md')), page


def test_every_benchmark_is_described():
    for script in (ROOT / 'benchmarks').glob('*.py'):
        assert f'benchmarks/{script.name}' in PAGES['docs/benchmarks.md'], script.name
