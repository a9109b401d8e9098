"""What is segmented: the rows of lists such as cases.csv and the phantoms, each an organ in a volume with a seed sphere."""

import csv
import os
from dataclasses import dataclass

import flipfree

# Those that the paper's table is about, and kidneys; in MR, which is a case of its own.
ORGANS = ("liver", "spleen", "kidney", "mr-liver", "mr-spleen", "mr-kidney")
PHANTOMS = "phantoms"  # in place of the name of a list


@dataclass(frozen=True)
class Case:
    name: str
    organ: str
    image: str
    labels: str
    label: int
    seed: tuple
    radius: float

    @property
    def scored(self):
        """Whether it belongs to the medians: a real organ of the kinds that the method is for."""
        return self.organ in ORGANS and not self.name.startswith("phantom")


def all_cases(data, lists, results):
    cases = []
    for name in lists:
        cases += phantom_cases(os.path.join(results, "phantoms")) if name == PHANTOMS else real_cases(data, name)
    return cases


def real_cases(data, name):
    """The default list is there only where the volumes are; any other that is missing is a mistake."""
    table = os.path.join(data, name)
    if name == "cases.csv" and not os.path.exists(table):
        return []
    with open(table, encoding="utf-8") as file:
        return [Case(row["case"], row["organ"], os.path.join(data, row["image"]), os.path.join(data, row["labels"]),
                     int(row["label_id"]), tuple(float(row["seed_" + axis]) for axis in "xyz"),
                     float(row["radius_mm"])) for row in csv.DictReader(file)]


def phantom_cases(folder):
    """The built-in shapes as files, each from the seed inside that it knows."""
    source = flipfree.vtkPhantomSource()
    shapes = (("abdomen", source.ABDOMEN, (("liver", source.LIVER), ("spleen", source.SPLEEN),
                                           ("kidney", source.RIGHT_KIDNEY))),
              ("cup", source.CUP, (("object", source.OBJECT),)),
              ("u-tube", source.U_TUBE, (("object", source.OBJECT),)),
              ("vessel", source.VESSEL, (("object", source.OBJECT),)))
    os.makedirs(folder, exist_ok=True)
    cases = []
    for shape, number, organs in shapes:
        image, labels = (os.path.join(folder, shape + end) for end in (".nii.gz", "-truth.nii.gz"))
        source.SetShape(number)
        source.Update()
        if not os.path.exists(labels):
            flipfree.write_image(source.GetOutput(), image)
            flipfree.write_image(source.GetLabelMap(), labels)
        for organ, label in organs:
            seed = [0.0] * 4
            source.GetSeed(label, seed)
            name = f"phantom-{shape}" + (f"-{organ}" if organ != "object" else "")
            cases.append(Case(name, organ, image, labels, label, tuple(seed[:3]), seed[3]))
    return cases
