"""FlipFree in any ParaView whose Python is that of this package: a plugin that nothing builds.

In ParaView: Tools > Manage Plugins > Load New, and choose this file. In scripts of pvpython and in
ParaView's Python Shell:

    import flipfree.paraview_plugin
    flipfree.paraview_plugin.load()

The properties are the parameters of flipfree.segment. The plugin in C++ has more: corrections,
organs together, vessels, and the stages as filters.
"""

import atexit
import importlib.util
import inspect
import os
import sys
import weakref
from typing import Any, NamedTuple
from xml.sax.saxutils import escape, quoteattr

_PACKAGE = os.path.dirname(os.path.realpath(__file__))
_FOLDER = os.path.dirname(_PACKAGE)
# For what the package needs, behind all that ParaView brings along.
if _FOLDER not in sys.path:
    sys.path.append(_FOLDER)


def _import_own_package() -> None:
    """ParaView loads this file by itself: the package is the one around it, not one on sys.path."""
    found = sys.modules.get("flipfree")
    if found is None:
        file = os.path.join(_PACKAGE, "__init__.py")
        spec = importlib.util.spec_from_file_location("flipfree", file)
        assert spec is not None and spec.loader is not None
        sys.modules["flipfree"] = package = importlib.util.module_from_spec(spec)
        try:
            spec.loader.exec_module(package)
        except BaseException:
            del sys.modules["flipfree"]
            raise
        return
    place = os.path.realpath(getattr(found, "__file__", None) or "an unknown place")
    if os.path.dirname(place) != _PACKAGE:
        raise ImportError(
            f"another flipfree has been imported already, from '{os.path.dirname(place)}'; "
            f"start ParaView again, and import only the one in '{_PACKAGE}'"
        )


class _ArgSpec(NamedTuple):
    args: Any
    varargs: Any
    keywords: Any
    defaults: Any


_import_own_package()
try:
    import paraview.util.vtkAlgorithm  # pylint: disable=unused-import
except ImportError as error:
    if error.name != "inspect":
        raise
    # ParaView 5.11 and 5.12 import it, and Python 3.11 has it no more.
    inspect.getargspec = (  # type: ignore[attr-defined]
        lambda function: _ArgSpec(*inspect.getfullargspec(function)[:4])
    )

from paraview.util.vtkAlgorithm import smhint, smproperty, smproxy
from vtkmodules.vtkCommonCore import vtkLogger
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkImageData
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase

import flipfree
from flipfree._backend import RADII, SEGMENT_PARAMETERS, SegmentationAlgorithm
from flipfree._errors import FlipFreeError
from flipfree._vtk_objects import imagedata_of
from flipfree.vtk import FlipFreeSegmentation as Filter

paraview_plugin_name = "FlipFree in Python"
paraview_plugin_version = flipfree.__version__

# Those that the panel shows without the gear.
BASIC = ("resolution", "label_value", "keep_history")
# How the XML calls an element and its range, by the type of its numbers.
ELEMENTS = {
    bool: ("Int", "BooleanDomain"),
    int: ("Int", "IntRangeDomain"),
    float: ("Double", "DoubleRangeDomain"),
}
# The parameters that are a choice of values, which the table has as numbers.
CHOICES = {"modality": ("Automatic", "CT", "MR")}

SEED = f"""
<OutputPort name="Surface" index="0"/>
<OutputPort name="Label map" index="1"/>
<OutputPort name="Convergence" index="2"/>
<OutputPort name="Questions" index="3"/>
<InputProperty name="Input" command="SetInputConnection" port_index="0">
  <DataTypeDomain name="input_type"><DataType value="vtkImageData"/></DataTypeDomain>
  <InputArrayDomain name="input_array" attribute_type="point" number_of_components="1"/>
  <Documentation>The CT or MR volume: an image with one scalar component.</Documentation>
</InputProperty>
<InputProperty name="StartSurface" label="Start Surface" command="SetInputConnection" port_index="1"
               null_on_empty="1" panel_visibility="never">
  <DataTypeDomain name="input_type"><DataType value="vtkPolyData"/></DataTypeDomain>
  <Documentation>
    A surface to start from instead of the sphere: closed, without self-intersections.
  </Documentation>
  <Hints><Optional/></Hints>
</InputProperty>
<DoubleVectorProperty name="SeedCenter" label="Seed Center" command="SetSeedCenter"
                      number_of_elements="3" default_values="none">
  <BoundsDomain name="range" mode="normal" default_mode="mid">
    <RequiredProperties><Property name="Input" function="Input"/></RequiredProperties>
  </BoundsDomain>
  <Documentation>Center of the seed sphere in millimeters; a point inside the organ.</Documentation>
</DoubleVectorProperty>
<DoubleVectorProperty name="SeedRadius" label="Seed Radius" command="SetSeedRadius"
                      number_of_elements="1" default_values="10">
  <DoubleRangeDomain name="range" min="{RADII[0]}"/>
  <Documentation>
    Radius of the seed sphere in millimeters, at least half that of the largest that fits.
  </Documentation>
</DoubleVectorProperty>
"""
GROUP = """
<PropertyGroup label="Seed" panel_widget="InteractiveSphere">
  <Property name="SeedCenter" function="Center"/>
  <Property name="SeedRadius" function="Radius"/>
</PropertyGroup>
"""
# Apply shows the surface only, in the image that stays: ParaView would hide the image, and open a
# table view for each of the tables.
HINTS = """
<ShowInMenu category="FlipFree"/>
<Visibility replace_input="0"/>
<View port="1" type="None"/>
<View port="2" type="None"/>
<View port="3" type="None"/>
"""


def load() -> None:
    """Loads the plugin, as Tools > Manage Plugins does."""
    from paraview import simple

    simple.LoadPlugin(os.path.abspath(__file__), remote=False, ns=vars(simple))


def _property_of(name: str, settings: Any) -> str:
    """A parameter as ParaView's XML has it."""
    parameter = SEGMENT_PARAMETERS[name]
    default = parameter.get(settings)
    values = default if isinstance(default, tuple) else (default,)
    element, domain = ELEMENTS[type(values[0])]
    limits = ""
    if name in CHOICES:
        entries = (
            f'<Entry text="{text}" value="{value}"/>' for value, text in enumerate(CHOICES[name])
        )
        domain, limits = "EnumerationDomain", f">{''.join(entries)}</EnumerationDomain>"
    elif domain == "BooleanDomain" or isinstance(default, tuple):
        limits = "/>"
    else:
        least, greatest = parameter.limits(SegmentationAlgorithm("default").settings)
        limits = f' min="{least}"' + ("/>" if greatest is None else f' max="{greatest}"/>')
    label = name.replace("_", " ").title()
    return (
        f'<{element}VectorProperty name="{parameter.property}" label={quoteattr(label)} '
        f'command="Set{parameter.property}" number_of_elements="{len(values)}" '
        f'default_values="{" ".join(str(int(x) if element == "Int" else x) for x in values)}" '
        f'panel_visibility="{"default" if name in BASIC else "advanced"}">'
        f'<{domain} name="range"{limits}'
        f"<Documentation>{escape(parameter.documentation)}</Documentation>"
        f"</{element}VectorProperty>"
    )


def _times() -> str:
    return (
        '<DoubleVectorProperty name="TimestepValues" information_only="1" '
        'si_class="vtkSITimeStepsProperty" repeatable="1">'
        "<TimeStepsInformationHelper/></DoubleVectorProperty>"
    )


def _properties() -> str:
    settings = SegmentationAlgorithm("default").settings
    return (
        SEED
        + "".join(_property_of(name, settings) for name in SEGMENT_PARAMETERS)
        + _times()
        + GROUP
    )


@smproxy.filter(
    name="FlipFreeSegmentationPython", label="Flip-Free Segmentation (Python)", support_reload=False
)
@smhint.xml(HINTS)
@smproperty.xml(_properties())
class FlipFreeSegmentationPython(Filter):
    """The whole method; see flipfree.vtk."""

    def __init__(self) -> None:
        super().__init__()
        _ALIVE.add(self)


# ParaView lets go of its filters only after Python's end, when the extension would complain of
# what is left.
_ALIVE: "weakref.WeakSet[Filter]" = weakref.WeakSet()


@atexit.register
def _let_go() -> None:
    for one in _ALIVE:
        one.__dict__.update(_algorithm=None, _organ=None)


@smproxy.reader(
    name="FlipFreeReaderPython",
    label="Medical Image (FlipFree, Python)",
    extensions="nii nii.gz nrrd nhdr mha mhd",
    file_description="Medical Images with Orientation (FlipFree, Python)",
    support_reload=False,
)
@smproperty.xml(
    '<StringVectorProperty name="FileName" command="SetFileName" number_of_elements="1" '
    'panel_visibility="never"><FileListDomain name="files"/>'
    "<Documentation>The volume.</Documentation></StringVectorProperty>"
)
class FlipFreeReaderPython(VTKPythonAlgorithmBase):  # type: ignore[misc]
    """Volumes with their place in space, in LPS mm, which ParaView's own readers leave out."""

    def __init__(self) -> None:
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkImageData")
        self._name = self._told = ""
        self._image: Any = None

    def SetFileName(self, name: str) -> None:
        if name != self._name:
            self._name, self._told, self._image = name, "", None
            self.Modified()

    def _read(self) -> Any:
        """The image, or None; what is wrong is told once, though ParaView asks again."""
        if self._image is None:
            try:
                self._image = imagedata_of(flipfree.read_image(self._name))
            except FlipFreeError as error:
                if str(error) != self._told:
                    self._told = str(error)
                    message = f"FlipFreeReaderPython: {error}"
                    vtkLogger.Log(vtkLogger.VERBOSITY_ERROR, __file__, 0, message)
        return self._image

    def RequestInformation(self, request: Any, inputs: Any, outputs: Any) -> int:
        del request, inputs
        image = self._read()
        if image is None:
            return 0
        information, matrix = outputs.GetInformationObject(0), image.GetDirectionMatrix()
        direction = [matrix.GetElement(row, column) for row in range(3) for column in range(3)]
        information.Set(vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT(), image.GetExtent(), 6)
        information.Set(vtkDataObject.SPACING(), image.GetSpacing(), 3)
        information.Set(vtkDataObject.ORIGIN(), image.GetOrigin(), 3)
        information.Set(vtkDataObject.DIRECTION(), direction, 9)
        return 1

    def RequestData(self, request: Any, inputs: Any, outputs: Any) -> int:
        del request, inputs
        image = self._read()
        if image is None:
            return 0
        vtkImageData.GetData(outputs, 0).ShallowCopy(image)
        return 1
