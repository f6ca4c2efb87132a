# SPDX-License-Identifier: GPL-3.0-or-later
"""The one list of what is tested in every host: the filters with their parameters, meshes, and wrong input.

Written by hand from what users are promised, not generated from the plugin's own table: it is what that table is
checked against."""
import pathlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / 'examples'
SHARED_MESHES = ROOT.parent / 'shared' / 'meshes'

_KEEP = ('keep_seams', 'crease_angle')
_SELECTED = ('selected_only',)
_SEGMENT = ('chart_count', 'max_fitting_error', 'fitting_weight', 'compactness_weight', 'straightness_weight',
            'max_iterations', 'reassigned_percent', 'seed_candidates', 'seed_percent', 'target_charts', 'max_stretch',
            *_KEEP, *_SELECTED)
_FILL = ('max_fitting_error', 'fitting_weight', 'compactness_weight', 'straightness_weight', 'small_hole_percent',
         *_KEEP, *_SELECTED)
_STRAIGHTEN = ('straighten_by', 'max_fitting_error', *_KEEP, *_SELECTED)
_MERGE = ('target_charts', 'max_stretch', 'merge_by', 'seam_weight', 'merge_threshold', *_KEEP, *_SELECTED)
_CUT = ('target_charts', 'max_stretch', 'dart_by', 'dart_fitting_error', 'max_dart_percent', 'cut_to_disk',
        'seam_layer', *_KEEP, *_SELECTED)
_PATTERN = ('target_charts', 'max_stretch', 'chart_count', 'max_fitting_error', 'fitting_weight', 'compactness_weight',
            'straightness_weight', 'merge_by', 'seam_weight', 'merge_threshold', 'dart_by', 'dart_fitting_error',
            'max_dart_percent', 'material', 'size', 'units', 'seam_allowance', 'tab_width', 'simplify_tolerance',
            'fold_angle', 'merge_congruent', 'print_texture', 'page', 'oversize', 'output_file', *_KEEP)
_PARAMETERIZE = ('target_charts', 'max_stretch', 'method', 'texture_size', 'padding', 'rotate', 'density_by',
                 *_SELECTED)

# display name -> (name in Python, parameters)
FILTERS = {
    'D-Charts: Segment': ('dcharts_segment', _SEGMENT),
    'D-Charts: Fill': ('dcharts_fill', _FILL),
    'D-Charts: Straighten': ('dcharts_straighten', _STRAIGHTEN),
    'D-Charts: Merge': ('dcharts_merge', _MERGE),
    'D-Charts: Cut': ('dcharts_cut', _CUT),
    'D-Charts: Parameterize': ('dcharts_parameterize', _PARAMETERIZE),
    'D-Charts: Texture Atlas': ('dcharts_texture_atlas',
                                tuple(dict.fromkeys(_SEGMENT + _FILL + _STRAIGHTEN + _MERGE + _CUT + _PARAMETERIZE))),
    'D-Charts: Pattern': ('dcharts_pattern', _PATTERN),
    'D-Charts: Measure': ('dcharts_measure', ()),
}
STAGES = tuple(python for python, _ in list(FILTERS.values())[:6])
PYTHON_NAMES = tuple(python for python, _ in FILTERS.values())

# parameter -> values that every filter with it must refuse, whatever the host's own widgets allow
OUT_OF_RANGE = {
    'chart_count': (-1,),
    'max_fitting_error': (0.0, -1.0, 4.5),
    'fitting_weight': (-0.5, 11.0),
    'compactness_weight': (-0.5, 11.0),
    'straightness_weight': (-0.5, 11.0),
    'max_iterations': (0, 10001),
    'reassigned_percent': (-1.0, 101.0),
    'seed_candidates': (0,),
    'seed_percent': (-1.0, 101.0),
    'small_hole_percent': (-1.0, 101.0),
    'target_charts': (-1,),
    'max_stretch': (-0.5, 1001.0),
    'crease_angle': (-1.0, 181.0),
    'seam_weight': (-0.5, 1001.0),
    'merge_threshold': (-0.1, 4.5),
    'dart_fitting_error': (-0.1, 4.5),
    'max_dart_percent': (-1.0, 1001.0),
    'texture_size': (15, 65537),
    'padding': (-1, 257),  # at most a quarter of the texture size, which is 1024
    'size': (-1.0, 100001.0),
    'seam_allowance': (-1.0, 101.0),
    'tab_width': (-1.0, 101.0),
    'simplify_tolerance': (-0.1, 101.0),
    'fold_angle': (-1.0, 181.0),
}

# every value of these is in range
BOOLEANS = ('cut_to_disk', 'seam_layer', 'rotate', 'merge_congruent', 'print_texture', 'keep_seams', 'selected_only')

# files to write
FILES = ('output_file',)

# parameter -> its choices, the default first
CHOICES = {
    'straighten_by': ('Graph Cut', 'Shortest Path'),
    'merge_by': ('Trial Flattening', 'Boundary Region'),
    'dart_by': ('Measured Stretch', 'Fitting Error'),
    'method': ('Stretch-minimizing', 'Conformal (ABF++)'),
    'density_by': ('Uniform', 'Vertex Quality'),
    'material': ('Fabric', 'Paper'),
    'units': ('mm', 'inch'),
    'page': ('Single sheet', 'A4', 'A3', 'A0', 'Letter'),
    'oversize': ('Tile', 'Split Piece'),
}

_TETRAHEDRON = ('0 0 0', '1 0 0', '0 1 0', '0 0 1')
_TETRAHEDRON_FACES = ('3 0 2 1', '3 0 1 3', '3 1 2 3', '3 0 3 2')

# what a user may hand over by mistake -> (vertices, faces) of an ASCII PLY
REFUSED_MESHES = {
    'empty mesh': ((), ()),
    'point cloud': (_TETRAHEDRON, ()),
    'NaN coordinate': (('nan 0 0',) + _TETRAHEDRON[1:], _TETRAHEDRON_FACES),
    'infinite coordinate': (('0 inf 0',) + _TETRAHEDRON[1:], _TETRAHEDRON_FACES),
    'zero area': (('0 0 0', '1 0 0', '2 0 0', '3 0 0'), ('3 0 1 2', '3 1 2 3')),
}


def write_ply(path, vertices, faces):
    """Writes an ASCII PLY of lines of vertices and faces."""
    header = ['ply', 'format ascii 1.0', f'element vertex {len(vertices)}', 'property float x', 'property float y',
              'property float z', f'element face {len(faces)}', 'property list uchar int vertex_indices', 'end_header']
    path.write_text('\n'.join([*header, *vertices, *faces]) + '\n')
    return path


def shipped_meshes():
    """The models of meshes/."""
    return sorted((ROOT / 'meshes').glob('*.ply'))


def is_sentence(text):
    """Something a user can read: words that end in a full stop, and nothing of a program's insides."""
    insides = ('std::', 'terminate', 'Assertion', 'what():', 'bad_alloc', '0x')
    return len(text.split()) >= 4 and text.rstrip().endswith('.') and not any(word in text for word in insides)
