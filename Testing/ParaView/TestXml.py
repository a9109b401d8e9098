"""The plugin's XML agrees with the filters: each property is there, with the filter's default and range, and is
documented. The filters are those of the Python package; ParaView is not needed."""

import glob
import os
import subprocess
import sys
import unittest
import xml.etree.ElementTree as ElementTree

import flipfree

SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
MAKE_XML = sys.argv.pop()
# So large that the panel need not show it.
PRACTICALLY_INFINITE = 1e6


def groups():
    for path in sorted(glob.glob(os.path.join(SOURCE, "Wrapping", "ParaView", "Plugin", "*.xml"))):
        yield from ElementTree.fromstring(subprocess.run([MAKE_XML, path], stdout=subprocess.PIPE, check=True).stdout)


# The proxies; what they inherit from, which are the stages' parameters and what the baselines share.
PROXIES = [proxy for group in groups() for proxy in group if not group.get("name").startswith("flipfree_")]
STAGES, BASES = ({base.get("name"): base for group in groups() for base in group if group.get("name") == name}
                 for name in ("flipfree_stages", "flipfree_bases"))
# Lists that a filter is told of one by one.
LISTS = {"Points": "AddPoint", "Labels": "AddLabel"}


def elements(proxy):
    """Of the proxy and of what it inherits from."""
    return [*proxy, *{**STAGES, **BASES}.get(proxy.get("base_proxyname"), ())]


def own_properties(proxy):
    """What a user sets of the proxy itself; inputs aside."""
    return {item.get("name"): item for item in elements(proxy)
            if item.tag.endswith("VectorProperty") and item.get("information_only") != "1"}


def exposed_properties(proxy):
    """What it shows of its sub-proxies: stage and name, by the name shown."""
    return {item.get("exposed_name", item.get("name")): (sub.find("Proxy").get("proxyname"), item.get("name"))
            for sub in proxy.findall("SubProxy") for item in sub.find("ExposedProperties")}


def filter_of(proxy):
    return getattr(flipfree, proxy.get("class"))()


def filter_properties(algorithm):
    ours = [kind for kind in type(algorithm).__mro__ if kind.__module__.startswith("flipfree")]
    return {name[3:] for kind in ours for name in vars(kind)
            if name.startswith("Set") and isinstance(getattr(algorithm, "Get" + name[3:], lambda: None)(),
                                                     (bool, int, float, tuple))}


def numbers(text):
    return [float(word) for word in text.split()]


class Xml(unittest.TestCase):
    def test_every_filter_is_a_proxy(self):
        classes = {name for name, value in vars(flipfree).items()
                   if isinstance(value, type) and name.startswith("vtk")}
        concrete = {name for name in classes if "* New();" in self.header(name)}
        self.assertGreater(len(concrete), 10)
        self.assertEqual(concrete, {proxy.get("class") for proxy in PROXIES})

    def header(self, name):
        (path,) = glob.glob(os.path.join(SOURCE, "Filters", "*", name + ".h"))
        with open(path, encoding="utf-8") as file:
            return file.read()

    def test_every_property_is_there_under_its_own_name(self):
        for proxy in PROXIES:
            with self.subTest(proxy=proxy.get("name")):
                own = own_properties(proxy)
                self.assertLessEqual(filter_properties(filter_of(proxy)), {*own, *exposed_properties(proxy)})
                for name, item in own.items():
                    self.assertEqual(item.get("command"), LISTS.get(name, "Set" + name))
                    # Python in ParaView calls a property by its label.
                    self.assertEqual(item.get("label", name).replace(" ", ""), name)

    def test_stages_show_all_their_parameters(self):
        (method,) = (proxy for proxy in PROXIES if proxy.get("class") == "vtkFlipFreeSegmentation")
        expected = [(stage, name) for stage in STAGES for name in own_properties(STAGES[stage])]
        self.assertEqual(sorted(exposed_properties(method).values()), sorted(expected))
        for sub in method.findall("SubProxy"):
            stage = sub.find("Proxy").get("proxyname")
            self.assertEqual(sub.get("command"), "Set" + stage)
            self.assertTrue(getattr(flipfree.vtkFlipFreeSegmentation(), "Get" + stage)().IsA(STAGES[stage].get("class")))

    def test_defaults_and_ranges_are_the_filters(self):
        checked = 0
        for proxy in PROXIES:
            algorithm = filter_of(proxy)
            for name in set(own_properties(proxy)) & filter_properties(algorithm):
                item = own_properties(proxy)[name]
                where = proxy.get("name") + "." + name
                value = getattr(algorithm, "Get" + name)()
                if item.find("BoundsDomain") is not None:
                    # ParaView would take a value that equals the XML's default for not set, and set it by the data.
                    self.assertEqual(item.get("default_values"), "none", where)
                    continue
                default = [float(number) for number in (value if isinstance(value, tuple) else (value,))]
                self.assertEqual(numbers(item.get("default_values")), default, where)
                self.assertEqual(int(item.get("number_of_elements")), len(default), where)
                checked += 1
                domain = item.find("IntRangeDomain" if item.tag.startswith("Int") else "DoubleRangeDomain")
                if isinstance(value, tuple) or domain is None:
                    continue
                for end, extreme in (("min", -2 ** 31), ("max", 2 ** 31 - 1)):
                    getattr(algorithm, "Set" + name)(extreme)
                    limit = getattr(algorithm, "Get" + name)()
                    if limit != extreme and (domain.get(end) or abs(limit) < PRACTICALLY_INFINITE):
                        self.assertEqual(float(domain.get(end)), limit, where)
        self.assertGreater(checked, 80)

    def test_everything_is_documented(self):
        for proxy in PROXIES:
            self.assertTrue(proxy.find("Documentation").get("short_help"), proxy.get("name"))
            for item in elements(proxy):
                if item.tag.endswith("Property"):
                    text = " ".join(" ".join(item.find("Documentation").itertext()).split())
                    where = proxy.get("name") + "." + item.get("name")
                    self.assertTrue(text.endswith("."), where)
                    if item.get("name") in own_properties(proxy):
                        self.assertRegex(text, "[Dd]efault", where)
                    if item.find("Hints/Optional") is not None:
                        self.assertRegex(text, "Optional", where)

    def test_groups_and_the_sphere_widget(self):
        for proxy in PROXIES:
            with self.subTest(proxy=proxy.get("name")):
                names = [*own_properties(proxy), *exposed_properties(proxy)]
                property_groups = [item for item in elements(proxy) if item.tag == "PropertyGroup"]
                grouped = [item.get("name") for group in property_groups for item in group]
                self.assertEqual(len(grouped), len(set(grouped)))
                self.assertLessEqual(set(grouped), {*names, "Input"})
                if exposed_properties(proxy):
                    self.assertEqual(set(names) - set(grouped), set())
                if "SeedCenter" in names:
                    (group,) = (group for group in property_groups if group.get("panel_widget") == "InteractiveSphere")
                    self.assertEqual({item.get("function"): item.get("name") for item in group},
                                     {"Center": "SeedCenter", "Radius": "SeedRadius", "Input": "Input"})


if __name__ == "__main__":
    unittest.main()
