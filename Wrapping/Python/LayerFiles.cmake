# The layer in Python that is the same over VTK's filters and over the kernels; what differs is beside it, in VTK
# and in Wheel.
set(FLIPFREE_LAYER_FILES
  _arrays.py
  _coordinates.py
  _corrections.py
  _boundary_found.py
  _errors.py
  _evaluate.py
  _faces.py
  _files.py
  _foreign.py
  _interrupt.py
  _labels.py
  _messages.py
  _parameters.py
  _phantom.py
  _progress.py
  _provenance.py
  _questions.py
  _segment.py
  _segment_organs.py
  _series.py
  _surfaces.py
  _trace.py
  _types.py
  _voxels.py
  py.typed)
