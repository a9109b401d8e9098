"""3D Slicer's module for FlipFree: nodes are chosen here, and flipfree.slicer does all the work.

Add the folder of this file under Edit > Application Settings > Modules > Additional module paths.
"""

import ctk
import qt
import slicer
from slicer.ScriptedLoadableModule import ScriptedLoadableModule, ScriptedLoadableModuleWidget

# How often the window is served during a run: as often as progress changes by this part.
PROGRESS_STEP = 0.01


class FlipFree(ScriptedLoadableModule):
    def __init__(self, parent):
        super().__init__(parent)
        parent.title = "FlipFree"
        parent.categories = ["Segmentation"]
        parent.contributors = ["The FlipFree developers"]
        parent.helpText = (
            "Segments the organ around a seed, an ROI or a line or points within it. Points inside and outside "
            "correct the segmentation; questions are about parts of which it is not sure."
        )


class FlipFreeWidget(ScriptedLoadableModuleWidget):
    def setup(self):
        super().setup()
        self.found = self.questions = None
        box = ctk.ctkCollapsibleButton()
        box.text = "Segment"
        self.layout.addWidget(box)
        form = qt.QFormLayout(box)
        self.volume = self._chooser(form, "Volume", "vtkMRMLScalarVolumeNode", adds=False)
        seeds = ("vtkMRMLMarkupsROINode", "vtkMRMLMarkupsLineNode", "vtkMRMLMarkupsFiducialNode")
        self.seeds = self._chooser(form, "Seed", *seeds)
        self.radius = qt.QDoubleSpinBox()
        self.radius.value, self.radius.suffix = 10, " mm"
        form.addRow("Radius of seeds that are points", self.radius)
        self.inside = self._chooser(form, "Inside", "vtkMRMLMarkupsFiducialNode", base="inside")
        self.outside = self._chooser(form, "Outside", "vtkMRMLMarkupsFiducialNode", base="outside")
        self.segmentation = self._chooser(form, "Segmentation", "vtkMRMLSegmentationNode")
        self.name = qt.QLineEdit("organ")
        form.addRow("Segment", self.name)
        self.progress = qt.QProgressBar()
        self.runs = self._button("Run", self.run)
        form.addRow(self.runs, self.progress)
        self.steps = (self._button("Undo", self.undo), self._button("Redo", self.redo))
        form.addRow(*self.steps)
        self.question = qt.QLabel()
        self.question.wordWrap = True
        form.addRow(self.question)
        self.answers = (self._button("Yes", self.yes), self._button("No", self.no))
        form.addRow(*self.answers)
        self.layout.addStretch(1)
        for chooser in (self.volume, self.seeds, self.segmentation):
            chooser.connect("currentNodeChanged(vtkMRMLNode*)", self.refresh)
        self.refresh()

    def run(self):
        """Segments, and asks the first question."""
        told = [0.0]

        def tell(fraction):
            if abs(fraction - told[0]) >= PROGRESS_STEP:
                told[0] = fraction
                self.progress.value = round(100 * fraction)
                slicer.app.processEvents(qt.QEventLoop.ExcludeUserInputEvents)

        with slicer.util.tryWithErrorDisplay("No segmentation.", waitCursor=True):
            import flipfree.slicer as ours

            self.found = ours.segment(
                self.volume.currentNode(),
                self.seeds.currentNode(),
                self.segmentation.currentNode(),
                [self.inside.currentNode(), self.outside.currentNode()],
                radius=self.radius.value,
                name=self.name.text,
                progress=tell,
            )
            self.segmentation.setCurrentNode(self.found.segmentationNode)
            self.questions = ours.questions(self.found, self.questions)
        self.progress.value = 0
        self.refresh()
        if self.asks():
            place = [0.0] * 3
            self.questions.GetNthControlPointPositionWorld(0, place)
            slicer.modules.markups.logic().JumpSlicesToLocation(*place, True)

    def asks(self):
        """Whether there is a question about what is chosen."""
        return (
            self.questions is not None
            and self.found.volumeNode is self.volume.currentNode()
            and self.found.segmentationNode is self.segmentation.currentNode()
            and self.questions.GetNumberOfControlPoints() > 0
        )

    def refresh(self):
        """Shows the first question; buttons can be pressed where there is something for them to do."""
        has_segmentation, asks = self.segmentation.currentNode() is not None, self.asks()
        self.question.text = self.questions.GetNthControlPointDescription(0) if asks else ""
        self.runs.enabled = None not in (self.volume.currentNode(), self.seeds.currentNode())
        for buttons, can_act in ((self.steps, has_segmentation), (self.answers, asks)):
            for button in buttons:
                button.enabled = can_act

    # Methods, since PythonQt gives a lambda with a default the button's state in its place.
    def yes(self):
        self.answer(True)

    def no(self):
        self.answer(False)

    def answer(self, yes):
        """The answer is a point among those inside or outside, where it can be removed again."""
        with slicer.util.tryWithErrorDisplay("No answer."):
            import flipfree.slicer as ours

            chooser = self.inside if yes else self.outside
            if chooser.currentNode() is None:
                chooser.addNode()
            ours.answer(self.questions, 0, yes, chooser.currentNode())
            self.run()

    def undo(self):
        self._step("undo")

    def redo(self):
        self._step("redo")

    def _step(self, name):
        """Undoes or does again; questions are about a result that is no longer shown."""
        with slicer.util.tryWithErrorDisplay(f"No {name}."):
            import flipfree.slicer as ours

            if getattr(ours, name)(self.segmentation.currentNode()) and self.questions is not None:
                self.questions.RemoveAllControlPoints()
        self.refresh()

    def _chooser(self, form, label, *kinds, adds=True, base=""):
        chooser = slicer.qMRMLNodeComboBox()
        chooser.nodeTypes = list(kinds)
        chooser.addEnabled = chooser.renameEnabled = chooser.removeEnabled = adds
        chooser.noneEnabled = True
        if base:
            chooser.baseName = base  # of which the labels of its points are made
        chooser.setMRMLScene(slicer.mrmlScene)
        form.addRow(label, chooser)
        return chooser

    def _button(self, text, action):
        button = qt.QPushButton(text)
        button.clicked.connect(action)
        return button
