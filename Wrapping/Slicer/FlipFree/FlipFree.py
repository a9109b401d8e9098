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
        form.addRow(self._button("Run", self.run), self.progress)
        form.addRow(self._button("Undo", self.undo), self._button("Redo", self.redo))
        self.question = qt.QLabel()
        self.question.wordWrap = True
        form.addRow(self.question)
        yes, no = (self._button(text, lambda value=value: self.answer(value)) for text, value in (("Yes", True), ("No", False)))
        self.answers = (yes, no)
        form.addRow(yes, no)
        self.layout.addStretch(1)
        self.ask()

    def run(self):
        """Segments, and asks the first question."""
        import flipfree.slicer as ours

        told = [0.0]

        def tell(fraction):
            if abs(fraction - told[0]) >= PROGRESS_STEP:
                told[0] = fraction
                self.progress.value = round(100 * fraction)
                slicer.app.processEvents(qt.QEventLoop.ExcludeUserInputEvents)

        with slicer.util.tryWithErrorDisplay("No segmentation.", waitCursor=True):
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
        self.ask()

    def ask(self):
        """Shows the first question, and the place that it is about."""
        asks = self.questions is not None and self.questions.GetNumberOfControlPoints() > 0
        self.question.text = self.questions.GetNthControlPointDescription(0) if asks else ""
        for button in self.answers:
            button.enabled = asks
        if asks:
            place = [0.0] * 3
            self.questions.GetNthControlPointPositionWorld(0, place)
            slicer.modules.markups.logic().JumpSlicesToLocation(*place, True)

    def answer(self, yes):
        """The answer is a point among those inside or outside, where it can be removed again."""
        import flipfree.slicer as ours

        chooser = self.inside if yes else self.outside
        if chooser.currentNode() is None:
            chooser.addNode()
        ours.answer(self.questions, 0, yes, chooser.currentNode())
        self.run()

    def undo(self):
        import flipfree.slicer as ours

        ours.undo(self.segmentation.currentNode())

    def redo(self):
        import flipfree.slicer as ours

        ours.redo(self.segmentation.currentNode())

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
