"""Each proxy can be created, and each of its properties reaches the filter or its stage, as the filter's own print-out
shows."""

import glob
import os
import re
import xml.etree.ElementTree as ElementTree

import session
from paraview import servermanager

PLUGIN = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Wrapping", "ParaView", "Plugin")
# Modules that are described in a file of another name than theirs.
MODULES = {"Stages": "Segmentation", "Vessels": "Segmentation"}
GROUPS = ("sources", "filters", "writers")


def modules():
    """Of the plugin; without ITK it has fewer."""
    libraries = glob.glob(os.path.join(os.environ["FLIPFREE_BUILD"], "**", "libFlipFree*.so"), recursive=True)
    return {re.match(r"libFlipFree(\w+)\.so", os.path.basename(library)).group(1) for library in libraries}


def descriptions():
    """The XML files of those modules."""
    there = modules()
    for file in glob.glob(os.path.join(PLUGIN, "*.xml")):
        name = os.path.splitext(os.path.basename(file))[0]
        if MODULES.get(name, name) in there:
            yield file


def proxies():
    """Group and name of all that the plugin brings."""
    manager = servermanager.vtkSMProxyManager.GetProxyManager().GetActiveSessionProxyManager()
    definitions = manager.GetProxyDefinitionManager()
    for group in GROUPS:
        item = definitions.NewSingleGroupIterator(group, 0)
        item.InitTraversal()
        while not item.IsDoneWithTraversal():
            name = item.GetProxyName()
            if name.startswith("FlipFree") or name == "OrientedImageReader":
                yield group, name
            item.GoToNextItem()


def printed(proxy):
    """What the filter prints, line by line, as lists of words; of equal names, its own come before its stages'."""
    proxy.UpdateVTKObjects()
    lines = re.findall(r"^ +(\w+): (.*)$", str(proxy.GetClientSideObject()), re.M)
    return {name: re.sub(r"[(),]", " ", value).split() for name, value in reversed(lines)}


def properties(proxy):
    """Names and properties that a user sets; inputs aside."""
    item = proxy.NewPropertyIterator()
    item.Begin()
    while not item.IsAtEnd():
        found = item.GetProperty()
        if (found.IsA("vtkSMVectorProperty") and found.GetCommand() and not found.GetInformationOnly()
                and not found.GetRepeatCommand()):
            yield item.GetKey(), found
        item.Next()


def elements(item):
    return [item.GetElement(index) for index in range(item.GetNumberOfElements())]


def other_values(item):
    """Values that the property does not have yet and that its domain allows."""
    if item.IsA("vtkSMStringVectorProperty"):
        return ["/no/such/file"]
    if item.GetDomain("bool"):
        return [1 - item.GetElement(0)]
    if item.GetDomain("enum"):
        return [1]
    step = 3 if item.IsA("vtkSMIntVectorProperty") else 0.375
    values = [value + step + index for index, value in enumerate(elements(item))]
    domain = item.GetDomain("range")
    if domain.GetMaximumExists(0) and max(values) > domain.GetMaximum(0):
        if item.IsA("vtkSMIntVectorProperty"):
            return [domain.GetMaximum(0) - 1]
        return [domain.GetMaximum(0) / 2]
    return values


class Proxies(session.SessionTest):
    def test_all_are_there(self):
        written = [(group.get("name"), proxy.get("name"))
                   for file in descriptions()
                   for group in ElementTree.parse(file).getroot() if group.get("name") in GROUPS for proxy in group]
        self.assertIn(("filters", "FlipFreeSegmentation"), written)
        self.assertEqual(sorted(proxies()), sorted(written))

    def test_each_property_reaches_the_filter(self):
        checked = 0
        for group, proxy_name in proxies():
            with self.subTest(proxy=proxy_name):
                proxy = servermanager.ProxyManager().NewProxy(group, proxy_name)
                for key, item in properties(proxy):
                    with self.subTest(property=key):
                        values = other_values(item)
                        name = item.GetCommand()[len("Set"):]
                        before = printed(proxy)[name]
                        for index, value in enumerate(values):
                            item.SetElement(index, value)
                        after = printed(proxy)[name]
                        self.assertNotEqual(before, after)
                        if item.GetDomain("enum") and not after[0].isdigit():
                            self.assertEqual(after[0], item.GetDomain("enum").GetEntryText(values[0]).lower())
                        else:
                            kind = type(values[0])
                            self.assertEqual([kind(word) for word in after[:len(values)]], values)
                        self.assertEqual(elements(item), values)
                        checked += 1
        self.assertGreater(checked, 80)

    def test_lists_reach_the_filter(self):
        proxy = servermanager.ProxyManager().NewProxy("filters", "FlipFreeVesselPath")
        points = proxy.GetProperty("Points")
        for values in ([1, 2, 3, 4, 5, 6, 7, 8, 9.5], [9, 8, 7, 6, 5, 4]):
            points.SetNumberOfElements(len(values))
            for index, value in enumerate(values):
                points.SetElement(index, value)
            proxy.UpdateVTKObjects()
            lines = re.findall(r"^ +Point: \((.*)\)$", str(proxy.GetClientSideObject()), re.M)
            self.assertEqual([float(word) for line in lines for word in line.split(",")], values)

    def test_ports_have_names(self):
        ports = {"FlipFreeSegmentation": ["Surface", "Label map", "Convergence", "Questions"],
                 "FlipFreeOrganGroup": ["Surfaces", "Label map", "Organs"],
                 "FlipFreeVesselSegmentation": ["Surface", "Label map", "Centerline", "Convergence"],
                 "FlipFreePhantom": ["Image", "Label map", "Surface"],
                 "FlipFreeSurfaceValidity": ["Surface", "Measures"]}
        for group, name in proxies():
            with self.subTest(proxy=name):
                proxy = servermanager.ProxyManager().NewProxy(group, name)
                if name in ports:
                    proxy.UpdateVTKObjects()
                    count = proxy.GetNumberOfOutputPorts()
                    self.assertEqual([proxy.GetOutputPortName(port) for port in range(count)], ports[name])


if __name__ == "__main__":
    session.main()
