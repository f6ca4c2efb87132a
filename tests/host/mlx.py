# SPDX-License-Identifier: GPL-3.0-or-later
"""MeshLab's filter scripts."""
import xml.etree.ElementTree as ElementTree

from cases import EXAMPLES, FILTERS

_READ = {'RichInt': int, 'RichFloat': float, 'RichBool': lambda text: text == 'true', 'RichEnum': int, 'RichSaveFile': str}


def read_script(path):
    """The script's filters in order, as (name in Python, {parameter: value})."""
    steps = []
    for node in ElementTree.parse(path).getroot().iter('filter'):
        values = {}
        for p in node.iter('Param'):
            value = _READ[p.get('type')](p.get('value'))
            values[p.get('name')] = p.get(f'enum_val{value}') if p.get('type') == 'RichEnum' else value
        steps.append((FILTERS[node.get('name')][0], values))
    return steps


def write_script(path, name, example, **changes):
    """Writes a script of one filter: the step `name` of the script `example` with some values changed."""
    tree = ElementTree.parse(example)
    root = tree.getroot()
    for node in list(root):
        if node.get('name') != name:
            root.remove(node)
    for parameter in root.iter('Param'):
        if parameter.get('name') in changes:
            value = changes.pop(parameter.get('name'))
            parameter.set('value', str(value).lower() if isinstance(value, bool) else str(value))
    assert len(root) == 1 and not changes, f'{name} {changes} is not in {example}'
    path.write_text('<!DOCTYPE FilterScript>\n' + ElementTree.tostring(root, encoding='unicode'))
    return path


def example_of(name):
    """The shipped script that has this filter."""
    return EXAMPLES / {'D-Charts: Texture Atlas': 'texture_atlas.mlx', 'D-Charts: Pattern': 'pattern.mlx'}.get(name, 'stages.mlx')


def one_filter(folder, name, **changes):
    """Writes a script of one filter, with some values other than the shipped ones."""
    path = folder / 'one.mlx'
    if not FILTERS[name][1]:
        path.write_text(f'<!DOCTYPE FilterScript>\n<FilterScript><filter name="{name}"/></FilterScript>')
        return path
    return write_script(path, name, example_of(name), **changes)


def field_number(name, parameter):
    """Which field of the filter's dialog is the parameter's, from 0: they have the order of the shipped scripts."""
    filters = ElementTree.parse(example_of(name)).getroot().iter('filter')
    (node,) = (node for node in filters if node.get('name') == name)
    return [p.get('name') for p in node.iter('Param')].index(parameter)
