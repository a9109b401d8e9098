"""The plugin's XML says the same as the filters' headers: every property is there, with the same default and range,
and is documented. Needs no ParaView."""

import glob
import os
import re
import unittest
import xml.etree.ElementTree as ElementTree

SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
SETTER = re.compile(
    r"vtkSet(Clamp|Vector\d?|String|FilePath|)Macro\((\w+)(?:,\s*(\w+))?(?:,\s*([^,)]+))?(?:,\s*([^)]+))?\)")
# So great that the panel need not show it.
PRACTICALLY_INFINITE = 1e6


class Header:
    """What a filter's header tells of its properties."""

    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            self.text = file.read()
        self.is_abstract = "* New();" not in self.text
        # What it inherits from a class of ours.
        for base in re.findall(r"class \w+ (\w+) : public (\w+)", self.text):
            for header in glob.glob(os.path.join(SOURCE, "Filters", "*", base[1] + ".h")):
                self.text += Header(header).text
        self.constants = {name: int(value) for name, value in re.findall(r"^\s+([A-Z_]+) = (\d+)", self.text, re.M)}
        self.ranges = {}
        for kind, name, _, low, high in SETTER.findall(self.text):
            self.ranges[name] = (self.number(low), self.number(high)) if kind == "Clamp" else None

    def number(self, text):
        return float(self.constants.get(text, text))

    def default(self, name):
        """The numbers the constructor sets; None for strings."""
        match = re.search(rf"^  (?:double|int|bool) {name}(?:\[\d\])? = (.*);", self.text, re.M)
        if not match:
            return None
        values = match.group(1).strip("{} ").replace("true", "1").replace("false", "0")
        return [self.number(value.strip()) for value in values.split(",")]


def proxies():
    for path in sorted(glob.glob(os.path.join(SOURCE, "Wrapping", "ParaView", "Plugin", "*.xml"))):
        for group in ElementTree.parse(path).getroot():
            yield from group


def with_headers():
    for proxy in proxies():
        (path,) = glob.glob(os.path.join(SOURCE, "Filters", "*", proxy.get("class") + ".h"))
        yield proxy, Header(path)


def settable(proxy):
    return [item for item in proxy if item.tag.endswith("VectorProperty") and item.get("information_only") != "1"]


def words(element):
    return " ".join(element.itertext()).split()


class Xml(unittest.TestCase):
    def test_every_filter_is_a_proxy(self):
        headers = glob.glob(os.path.join(SOURCE, "Filters", "*", "vtk*.h"))
        classes = {os.path.basename(path)[:-2] for path in headers if not Header(path).is_abstract}
        self.assertGreater(len(classes), 10)
        self.assertEqual(classes, {proxy.get("class") for proxy in proxies()})

    def test_every_property_is_there_under_its_own_name(self):
        reader = {"SeriesUID"}  # of the reader of single files
        for proxy, header in with_headers():
            with self.subTest(proxy=proxy.get("name")):
                names = {item.get("name") for item in settable(proxy)}
                missing = set(header.ranges) - names
                self.assertLessEqual(missing, reader if proxy.get("name") == "OrientedImageReader" else set())
                for item in settable(proxy):
                    self.assertEqual(item.get("command"), "Set" + item.get("name"))
                    # Python in ParaView calls a property by its label.
                    self.assertEqual(item.get("label", item.get("name")).replace(" ", ""), item.get("name"))

    def test_defaults_are_the_filters(self):
        checked = 0
        for proxy, header in with_headers():
            with self.subTest(proxy=proxy.get("name")):
                for item in settable(proxy):
                    default = header.default(item.get("name"))
                    if default is None:
                        continue
                    checked += 1
                    if item.find("BoundsDomain") is not None:
                        # ParaView would take a value that equals the XML's default for not set, and set it by the data.
                        self.assertEqual(item.get("default_values"), "none")
                        continue
                    given = [float(value) for value in item.get("default_values").split()]
                    self.assertEqual(given, default, item.get("name"))
                    self.assertEqual(len(given), int(item.get("number_of_elements")))
        self.assertGreater(checked, 80)

    def test_ranges_are_the_filters(self):
        checked = 0
        for proxy, header in with_headers():
            with self.subTest(proxy=proxy.get("name")):
                for item in settable(proxy):
                    limits = header.ranges.get(item.get("name"))
                    domain = item.find("DoubleRangeDomain")
                    domain = item.find("IntRangeDomain") if domain is None else domain
                    if limits is None or domain is None:
                        continue
                    checked += 1
                    self.assertEqual(float(domain.get("min")), limits[0], item.get("name"))
                    if limits[1] < PRACTICALLY_INFINITE or domain.get("max"):
                        self.assertEqual(float(domain.get("max")), limits[1], item.get("name"))
        self.assertGreater(checked, 50)

    def test_everything_is_documented(self):
        for proxy in proxies():
            self.assertTrue(proxy.find("Documentation").get("short_help"), proxy.get("name"))
            for item in proxy:
                if not item.tag.endswith("Property"):
                    continue
                text = " ".join(words(item.find("Documentation")))
                where = proxy.get("name") + "." + item.get("name")
                self.assertTrue(text.endswith("."), where)
                if item in settable(proxy):
                    self.assertRegex(text, "[Dd]efault", where)
                if item.find("Hints/Optional") is not None:
                    self.assertRegex(text, r"Optional|Needed if", where)

    def test_seeds_have_the_sphere_widget(self):
        for proxy, header in with_headers():
            with self.subTest(proxy=proxy.get("name")):
                if "SeedCenter" not in header.ranges:
                    continue
                group = proxy.find("PropertyGroup[@panel_widget='InteractiveSphere']")
                self.assertEqual({item.get("function"): item.get("name") for item in group},
                                 {"Center": "SeedCenter", "Radius": "SeedRadius", "Input": "Input"})

    def test_groups_name_properties_that_exist_and_each_once(self):
        for proxy in proxies():
            names = [item.get("name") for item in proxy if item.tag.endswith("Property")]
            grouped = [item.get("name") for item in proxy.findall("PropertyGroup/Property")]
            self.assertEqual(len(grouped), len(set(grouped)))
            self.assertLessEqual(set(grouped), set(names))
            if proxy.get("name") == "FlipFreeSegmentation":
                left = {item.get("name") for item in settable(proxy)} - set(grouped)
                self.assertEqual(left, set())


if __name__ == "__main__":
    unittest.main()
