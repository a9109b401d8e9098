"""What the examples segment: a file of the user's, or else the built-in abdomen phantom."""

import argparse

import flipfree
import scene


def phantom(noisy=False):
    """A schematic CT of the upper abdomen; its second output is the truth, organ by organ.

    If it is noisy, there is a question about its liver.
    """
    source = flipfree.vtkPhantomSource()
    source.SetShapeToAbdomen()
    if noisy:
        source.SetNoiseStandardDeviation(20)
        source.SetRandomSeed(2)
    source.Update()
    return source


def seed_in(source, label):
    """Center and radius of a ball deep inside an organ of the phantom."""
    seed = [0.0] * 4
    source.GetSeed(label, seed)
    return seed[:3], seed[3]


def parse(description, parser=None):
    """The command line that the examples share, besides what the parser given knows already."""
    parser = parser or argparse.ArgumentParser(description=description.splitlines()[0])
    parser.add_argument("image", nargs="?", help="file or DICOM folder (default: the phantom)")
    parser.add_argument("--seed", nargs=3, type=float, metavar=("X", "Y", "Z"),
                        help="center of a sphere within the organ, LPS mm")
    parser.add_argument("--radius", type=float, help="its radius, mm")
    parser.add_argument("--picture", help="PNG to draw the result into")
    arguments = parser.parse_args()
    if arguments.image and not (arguments.seed and arguments.radius):
        parser.error("an image needs --seed X Y Z and --radius R")
    if not arguments.image and (arguments.seed or arguments.radius):
        parser.error("--seed and --radius go with an image; the phantom has a seed of its own")
    if arguments.picture:
        scene.require_display()  # before anything is segmented
    return arguments


def image_and_seed(arguments, label=flipfree.vtkPhantomSource.LIVER):
    """The image, and center and radius of the seed."""
    if arguments.image:
        return flipfree.read_image(arguments.image), arguments.seed, arguments.radius
    source = phantom()
    return (source.GetOutput(), *seed_in(source, label))
