#pragma once
// The panels that keep nothing between frames. Each draws the workspace's snapshot into the ImGui window that is open.

#include "ui/workspace.h"

namespace adit::ui {

/// Name, scans and findings; a click on a scan selects it.
void draw_job(Workspace& workspace);

/// State of every step, the buttons to run and to cancel, how the last run ended.
void draw_steps(Workspace& workspace);

/// Where every scan stands and how well it is known, pairs, residuals of the control points.
void draw_registration(Workspace& workspace);

/// Volumes of every line and round with their uncertainty.
void draw_volumes(Workspace& workspace);

}  // namespace adit::ui
