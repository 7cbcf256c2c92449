"""How an operator runs: in the background of Blender's window with progress, or straight through."""

import bpy

from ..core import job, routes
from ..core.refusal import Refusal, Stopped
from ..preferences import preferences_of
from ..scene import selection

_interval = 0.1  # seconds between two looks at a job
_watched = []


def jobs():
    """The jobs that run in threads now, until their operators have ended."""
    return list(_watched)


class RunningOperator:
    """What operators share. An operator has

    gather(context)          what the work needs, read from Blender; raises Refusal
    work(gathered)           a function of route and folder that knows nothing of Blender
    finish(context, result)  writes the result; returns a line for the status bar

    From the menu the work is in a thread: the status bar shows how far it is, Esc stops it, and nothing
    has changed then. From scripts, and without a window, it runs through.
    """

    _job = None
    _timer = None

    @classmethod
    def poll(cls, context):
        if context.mode != "OBJECT":
            cls.poll_message_set("Object Mode is needed")
            return False
        if context.object is None or context.object.type != "MESH":
            cls.poll_message_set("A mesh is needed as the active object")
            return False
        return True

    def execute(self, context):
        try:
            self._begin(context)
        except Refusal as refusal:
            return self._refuse(context, refusal)
        return self._end(context)

    def modal(self, context, event):
        if event.type == "ESC":
            self._job.stop()
        if event.type != "TIMER":
            return {"RUNNING_MODAL"}
        if self._job.is_done:
            self._hide_progress(context)
            return self._end(context)
        stage, fraction = self._job.told
        context.window_manager.progress_update(100 * fraction)
        context.workspace.status_text_set(f"{self.bl_label}: {stage} {100 * fraction:.0f} %    Esc: stop")
        return {"RUNNING_MODAL"}

    def run_watched(self, context):
        """What `invoke` does: execute, but watched."""
        if bpy.app.background:
            return self.execute(context)
        try:
            self._begin(context)
        except Refusal as refusal:
            return self._refuse(context, refusal)
        self._job.start()
        _watched.append(self._job)
        context.window_manager.progress_begin(0, 100)
        self._timer = context.window_manager.event_timer_add(_interval, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def invoke(self, context, event):
        return self.run_watched(context)

    def _begin(self, context):
        wanted = preferences_of(context)
        route = routes.choose(wanted.route, wanted.package_folder, wanted.program, wanted.threads)
        self._job = job.Job(route, self.work(self.gather(context)))

    def _end(self, context):
        try:
            line = self.finish(context, self._job.result())
        except Stopped:
            self.report({"WARNING"}, f"{self.bl_label}: stopped, nothing has changed")
            return {"CANCELLED"}
        except Refusal as refusal:
            return self._refuse(context, refusal)
        self.report({"INFO"}, line)
        return {"FINISHED"}

    def _refuse(self, context, refusal):
        """Tells why; what is at fault is selected, to be seen in Edit Mode."""
        message = str(refusal)
        found = getattr(refusal, "surface", None)
        if refusal.elements and found in bpy.data.objects:
            message += "\n" + selection.select(context, bpy.data.objects[found], refusal.elements)
        self.report({"ERROR"}, message)
        return {"CANCELLED"}

    def _hide_progress(self, context):
        _watched.remove(self._job)
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.progress_end()
        context.workspace.status_text_set(None)


def selected_meshes(context):
    """Selected mesh objects, the active one first where it is among them, each mesh once.

    Raises Refusal where there is none: as for Blender's own operators, being active is not enough.
    """
    objects = sorted(context.selected_objects, key=lambda obj: obj != context.object)
    found = {}
    for obj in objects:
        if obj.type == "MESH":
            found.setdefault(obj.data.name_full, obj)
    if not found:
        raise Refusal("No mesh is selected: click it in the viewport, or press A for all")
    return list(found.values())


def require_editable(obj):
    """Raises Refusal where a mesh belongs to another file."""
    if obj.data.library is not None:
        raise Refusal(f"{obj.name} is linked from another file: Object › Relations › Make Local")
